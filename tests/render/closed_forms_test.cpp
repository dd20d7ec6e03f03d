// Pictures whose every pixel is known: furnaces, and a floor under simple lights.
#include "doctor/furnaces.h"
#include "render/picture.h"
#include "support/folders.h"

#include <cmath>
#include <numbers>

namespace onde::test {
namespace {

using doctor::add_square_light;
using doctor::furnace;
using doctor::irradiance_below_square;

constexpr float PI = std::numbers::pi_v<float>;

Material material_of(MaterialKind kind, float color, float roughness = 1) {
    return doctor::furnace_material(kind, glm::vec3(color), roughness);
}

struct Statistics {
    double mean = 0, low = 1e30, high = -1e30;
    double deviation = 0; ///< of the mean
};
Statistics statistics(const Image& image) {
    Statistics s;
    const auto count = double(image.pixels.size());
    double squares = 0;
    for (float value : image.pixels) {
        s.mean += value / count;
        squares += double(value) * value / count;
        s.low = std::min(s.low, double(value));
        s.high = std::max(s.high, double(value));
    }
    // The channels of a pixel go together.
    s.deviation = std::sqrt(std::max(squares - s.mean * s.mean, 0.0) / (count / image.channels));
    return s;
}

/// From straight above.
Scene floor_seen_from_above() {
    Scene scene = doctor::floor_seen_from_above(0.5f);
    scene.cameras = {camera_at({0, 1, 0}, {0, 0, 0}, 0.002f)};
    return scene;
}

} // namespace

TEST_CASE("a white diffuse sphere vanishes in a white furnace") {
    RenderOptions options = small_options(24, 24, 1024);
    options.depth = 24;
    options.roulette_start = 24;
    const Statistics s =
        statistics(render_scene(furnace(material_of(MaterialKind::diffuse, 1)), options).image);
    CHECK(std::abs(s.mean - 1) < 1e-3);
    CHECK(s.low > 0.93);
    CHECK(s.high < 1.07);
}

TEST_CASE("smooth clear glass vanishes in a white furnace, pixel by pixel") {
    RenderOptions options = small_options(24, 24, 4);
    options.depth = 63;
    options.roulette_start = 63;
    const Statistics s = statistics(
        render_scene(furnace(material_of(MaterialKind::dielectric, 1, 0)), options).image);
    CHECK(std::abs(s.low - 1) < 2e-5);
    CHECK(std::abs(s.high - 1) < 2e-5);
}

TEST_CASE("a perfect mirror vanishes in a white furnace, pixel by pixel") {
    const Statistics s = statistics(
        render_scene(furnace(material_of(MaterialKind::conductor, 1, 0)), small_options(24, 24, 4))
            .image);
    CHECK(std::abs(s.low - 1) < 1e-5);
    CHECK(std::abs(s.high - 1) < 1e-5);
}

TEST_CASE("a white ball returns all light, however rough, whatever it is made of") {
    for (const MaterialKind kind :
         {MaterialKind::conductor, MaterialKind::dielectric, MaterialKind::metallic_roughness})
        for (const float roughness : {0.2f, 0.5f, 1.0f}) {
            RenderOptions options = small_options(24, 24, 256);
            options.depth = 63;
            INFO("kind " << int(kind) << ", roughness " << roughness);
            const Statistics s =
                statistics(render_scene(furnace(material_of(kind, 1, roughness)), options).image);
            INFO("mean " << s.mean << ", deviation " << s.deviation);
            CHECK(s.deviation < 0.003);
            CHECK(s.mean > 0.99 - 4 * s.deviation);
            CHECK(s.mean < 1.001 + 4 * s.deviation);
        }
}

TEST_CASE("a file's white metal of roughness 1 returns all light") {
    const Scene scene =
        load_scene(std::filesystem::path(in_project("tests/data/furnace/rough-metal.toml")));
    const Statistics s = statistics(render_scene(scene, small_options(32, 32, 256)).image);
    INFO("mean " << s.mean << ", deviation " << s.deviation);
    CHECK(s.deviation < 0.003);
    CHECK(s.mean > 0.99 - 4 * s.deviation);
    CHECK(s.mean < 1.001 + 4 * s.deviation);
}

TEST_CASE("rough glass of the index of air is not seen") {
    Material glass = material_of(MaterialKind::dielectric, 1, 0.5f);
    glass.ior = 1.0f;
    const Picture picture = render_scene(furnace(glass), small_options(24, 24, 16));
    const Statistics s = statistics(picture.image);
    CHECK(picture.invalid.count == 0);
    CHECK(std::abs(s.low - 1) < 1e-5);
    CHECK(std::abs(s.high - 1) < 1e-5);
}

TEST_CASE("a square light gives the irradiance of its closed form") {
    Scene scene = floor_seen_from_above();
    scene.cameras = {camera_at({0, 0.5f, 0}, {0, 0, 0}, 0.002f)};
    add_square_light(scene, 1.0f, 1.5f, 3.0f);
    RenderOptions options = small_options(8, 8, 4096);
    options.depth = 2;
    const double expected = 0.5 / PI * irradiance_below_square(1.0, 1.5, 3.0);
    const Statistics s = statistics(render_scene(scene, options).image);
    CHECK(std::abs(s.mean / expected - 1) < 1e-3);
}

TEST_CASE("a point light falls off with the square of the distance") {
    Scene scene = floor_seen_from_above();
    scene.point_lights = {{{0, 2, 0}, glm::vec3(10)}};
    RenderOptions options = small_options(4, 4, 16);
    const Statistics s = statistics(render_scene(scene, options).image);
    CHECK(std::abs(s.mean / (0.5 / PI * 10 / 4) - 1) < 1e-4);
}

TEST_CASE("a directional light gives its irradiance times the cosine") {
    Scene scene = floor_seen_from_above();
    scene.directional_lights = {{glm::normalize(glm::vec3(1, 1, 0)), glm::vec3(2)}};
    const Statistics s = statistics(render_scene(scene, small_options(4, 4, 16)).image);
    CHECK(std::abs(s.mean / (0.5 / PI * 2 * std::sqrt(0.5)) - 1) < 1e-4);
}

TEST_CASE("a sphere light gives the irradiance of a point at its centre") {
    Scene scene = floor_seen_from_above();
    Material light = material_of(MaterialKind::diffuse, 0);
    light.emission = glm::vec3(5);
    scene.materials.push_back(light);
    scene.spheres = {{glm::vec3(1.5f, 2, 0), 0.5f, 1}};
    RenderOptions options = small_options(8, 8, 1024);
    options.depth = 2;
    const double distance2 = 1.5 * 1.5 + 4, cosine = 2 / std::sqrt(distance2);
    const double expected = 0.5 * 5 * 0.25 / distance2 * cosine;
    const Statistics s = statistics(render_scene(scene, options).image);
    CHECK(std::abs(s.mean / expected - 1) < 2e-3);
}

TEST_CASE("depth 1 shows emitters only, and their radiance exactly") {
    Scene scene = furnace(material_of(MaterialKind::diffuse, 1));
    scene.materials[0].emission = glm::vec3(0.25f, 2, 7);
    RenderOptions options = small_options(5, 5, 4);
    options.depth = 1;
    const Image image = render_scene(scene, options).image;
    CHECK(image.pixel(2, 2)[0] == 0.25f);
    CHECK(image.pixel(2, 2)[1] == 2.0f);
    CHECK(image.pixel(2, 2)[2] == 7.0f);
}

} // namespace onde::test
