// Coarser levels of textures where many texels lie in a pixel: the same mean with less noise.
#include "render/same_bits.h"
#include "scene/shapes.h"
#include "upload/geometry.h"
#include "upload/uv_scale.h"

#include <glm/gtc/matrix_transform.hpp>

#include <random>

namespace onde::test {
namespace {

constexpr uint32_t SIDE = 512;

/// An unlit square of 4 x 4 in the XY plane with a texture of noise, seen from `distance`.
Scene noisy_square(TextureFilter filter, float distance) {
    Scene scene;
    Texture noise;
    noise.filter = filter;
    noise.image.width = noise.image.height = SIDE;
    std::mt19937 generator(3);
    for (uint32_t i = 0; i < 4 * SIDE * SIDE; i++)
        noise.image.rgba.push_back(i % 4 == 3 ? uint8_t(255) : uint8_t(generator()));
    scene.textures.push_back(noise);
    Material material;
    material.kind = MaterialKind::unlit;
    material.base_color = glm::vec3(1);
    material.base_color_texture = 0;
    scene.materials = {material};
    Mesh square;
    square.positions = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
    square.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    square.materials = {0, 0};
    scene.meshes = {square};
    scene.instances = {{0, glm::mat4(1)}};
    scene.cameras = {camera_at({0, 0, distance}, {0, 0, 0}, 0.4f)};
    return scene;
}

struct Statistics {
    double mean = 0, variance = 0; ///< of pixels
};

Statistics statistics_of(const Scene& scene, uint32_t samples = 4) {
    const Image image = render_scene(scene, small_options(16, 16, samples)).image;
    Statistics s;
    double squares = 0;
    for (const float value : image.pixels) {
        s.mean += double(value) / double(image.pixels.size());
        squares += double(value) * double(value) / double(image.pixels.size());
    }
    s.variance = squares - s.mean * s.mean;
    return s;
}

} // namespace

TEST_CASE("coarser levels take noise from what is far away, and leave the mean") {
    // A pixel sees some 28 x 28 texels; four samples of a bilinear lookup see four times four.
    const Statistics plain = statistics_of(noisy_square(TextureFilter::linear, 9));
    const Statistics filtered = statistics_of(noisy_square(TextureFilter::mip, 9));
    CHECK(filtered.variance < plain.variance / 30);
    CHECK(filtered.mean == Approx(plain.mean).margin(4 * std::sqrt(plain.variance / 768)));
}

TEST_CASE("near textures keep their bits beside their coarser levels") {
    const RenderOptions options = small_options(16, 16, 4);
    const Image plain = render_scene(noisy_square(TextureFilter::linear, 0.2f), options).image;
    const Image filtered = render_scene(noisy_square(TextureFilter::mip, 0.2f), options).image;
    CHECK(first_difference(plain, filtered) == "");
}

TEST_CASE("levels go by the size of what is placed, scaled or turned") {
    constexpr float DISTANCE = 6;
    const auto seen = [](float scale) {
        Scene scene = noisy_square(TextureFilter::mip, DISTANCE * scale);
        const glm::mat4 turned = glm::rotate(glm::mat4(1), 0.5f, glm::vec3(0, 0, 1));
        const glm::mat4 placed = glm::scale(turned, glm::vec3(scale));
        Mesh& mesh = scene.meshes[0]; // of so many triangles that it is not baked
        mesh.triangles.resize(BAKED_COPIES, glm::uvec3(0));
        mesh.materials.resize(BAKED_COPIES);
        scene.instances = {{0, placed}, {0, glm::translate(placed, glm::vec3(100, 0, 0))}};
        REQUIRE(pack_scene(scene).features.instances);
        return statistics_of(scene);
    };
    const Statistics plain = statistics_of(noisy_square(TextureFilter::linear, DISTANCE));
    const Statistics middle = seen(1);
    CHECK(middle.variance < plain.variance / 15);
    CHECK(seen(0.01f).variance == Approx(middle.variance).epsilon(0.1));
    CHECK(seen(50).variance == Approx(middle.variance).epsilon(0.1));
}

TEST_CASE("levels go by the repetition of a texture, and by its own coordinates") {
    Scene once = noisy_square(TextureFilter::mip, 9), often = once;
    often.textures[0].transform.scale = glm::vec2(8);
    CHECK(statistics_of(often).variance < statistics_of(once).variance / 8);
}

TEST_CASE("textures with coarser levels have the same bits in all engines and lanes") {
    Scene scene = noisy_square(TextureFilter::mip, 9);
    scene.materials[0].kind = MaterialKind::diffuse;
    scene.environment.radiance = glm::vec3(1);
    check_same_bits(scene, small_options(16, 16, 4));
}

TEST_CASE("the scale of texture coordinates is that of the direction in which they grow least") {
    const glm::vec3 square[3] = {{0, 0, 1}, {2, 0, 1}, {0, 2, 1}};
    const auto scale = [&](glm::vec2 b, glm::vec2 c) {
        const glm::vec2 uvs[3] = {{0.5f, 0.5f}, b + 0.5f, c + 0.5f};
        return uv_scale(square, uvs);
    };
    CHECK(scale({1, 0}, {0, 1}) == Approx(0.5));
    CHECK(scale({0, -6}, {6, 0}) == Approx(3));
    CHECK(scale({1, 0}, {0, 10}) == Approx(0.5));
    CHECK(scale({1, 0}, {1, 1}) == Approx(0.5 * (std::sqrt(5) - 1) / 2)); // sheared
    CHECK(scale({1, 1}, {2, 2}) == Approx(0).margin(1e-6));
    CHECK(scale({0, 0}, {0, 0}) == 0);
    const glm::vec3 needle[3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    const glm::vec2 uvs[3] = {{0, 0}, {1, 0}, {0, 1}};
    CHECK(uv_scale(needle, uvs) == 0);
}

} // namespace onde::test
