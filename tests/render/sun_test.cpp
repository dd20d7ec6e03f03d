// Suns and measured lamps in pictures: closed forms, other lights that are alike, light tracing.
#include "doctor/furnaces.h"
#include "doctor/light_rig.h"
#include "render/light_picture.h"
#include "render/variants.h"
#include "scene/light_groups.h"
#include "upload/ground.h"

#include <cmath>
#include <numbers>

namespace onde::test {
namespace {

constexpr double PI = std::numbers::pi;

double radians(double degrees) {
    return degrees * PI / 180;
}

DirectionalLight sun_at(double elevation, double angle, glm::vec3 irradiance = glm::vec3(2)) {
    const double e = radians(elevation);
    return {.to_light = glm::vec3(glm::dvec3(std::cos(e), std::sin(e), 0)),
            .irradiance = irradiance,
            .angle = float(radians(angle))};
}

double mean_of(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += double(value);
    return sum / double(image.pixels.size());
}

/// Of a disk of radiance 1 on a plane whose normal its middle stands at that elevation to, by
/// Riemann sums over its cap.
double irradiance_of_disk(double elevation, double angle) {
    constexpr int STEPS = 2000;
    const double half = radians(angle) / 2, e = radians(elevation);
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double a = half * (i + 0.5) / STEPS;
        for (int j = 0; j < STEPS; j++) {
            const double up = std::sin(e) * std::cos(a) +
                              std::cos(e) * std::sin(a) * std::cos(2 * PI * (j + 0.5) / STEPS);
            sum += std::max(up, 0.0) * std::sin(a);
        }
    }
    return sum * (half / STEPS) * (2 * PI / STEPS);
}

/// Glossy and diffuse balls on a floor, lit by nothing yet.
Scene balls() {
    Scene scene;
    doctor::add_triangle(scene, {-9, 0, 9}, {9, 0, 9}, {0, 0, -9}, Material{});
    for (uint32_t i = 0; i < 3; i++) {
        Material material;
        material.kind = MaterialKind::metallic_roughness;
        material.base_color = {0.9f, 0.6f, 0.3f};
        material.metallic = float(i) / 2;
        material.roughness = 0.2f + 0.3f * float(i);
        scene.spheres.push_back(
            {{float(i) - 1.0f, 0.45f, 0}, 0.45f, uint32_t(scene.materials.size())});
        scene.materials.push_back(material);
    }
    scene.cameras = {camera_at({0, 2, 5}, {0, 0.4f, 0}, 0.6f)};
    return scene;
}

/// An environment with that disk, as smooth at its rim as pixels make it.
Image map_of(const DirectionalLight& sun) {
    constexpr uint32_t WIDTH = 1024, FINE = 4;
    const double half = double(sun.angle) / 2, sine = std::sin(half);
    const double radiance = double(sun.irradiance.x) / (PI * sine * sine);
    Image map(WIDTH, WIDTH / 2, 3);
    for (uint32_t y = 0; y < map.height; y++)
        for (uint32_t x = 0; x < map.width; x++) {
            double inside = 0;
            for (uint32_t k = 0; k < FINE * FINE; k++) {
                const double u = (x + (k % FINE + 0.5) / FINE) / WIDTH;
                const double v = (y + (k / FINE + 0.5) / FINE) / map.height;
                const double azimuth = 2 * PI * (u - 0.5), polar = PI * v;
                const glm::dvec3 d(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                   -std::sin(polar) * std::cos(azimuth));
                inside += glm::dot(d, glm::dvec3(sun.to_light)) > std::cos(half);
            }
            std::ranges::fill(map.pixel(x, y), float(radiance * inside / (FINE * FINE)));
        }
    return map;
}

} // namespace

TEST_CASE("a sun gives a tilted plane its irradiance times the cosine") {
    Scene scene = doctor::floor_seen_from_above(0.5f);
    scene.cameras = {camera_at({0, 1, 0}, {0, 0, 0}, 0.002f)};
    for (const double angle : {0.53, 60.0}) {
        scene.directional_lights = {sun_at(40, angle)};
        RenderOptions options = small_options(8, 8, 1024);
        options.depth = 2;
        const double expected = 0.5 / PI * 2 * std::sin(radians(40));
        CHECK(mean_of(render_scene(scene, options).image) == Approx(expected).epsilon(2e-3));
    }
}

TEST_CASE("of a sun that is half below the horizon counts what is above") {
    Scene scene = doctor::floor_seen_from_above(0.5f);
    scene.cameras = {camera_at({0, 1, 0}, {0, 0, 0}, 0.002f)};
    for (const double elevation : {-5.0, 0.0, 10.0}) {
        INFO(elevation << " degrees");
        scene.directional_lights = {sun_at(elevation, 40)};
        RenderOptions options = small_options(8, 8, 4096);
        options.depth = 2;
        const double sine = std::sin(radians(20));
        const double irradiance = 2 / (PI * sine * sine) * irradiance_of_disk(elevation, 40);
        CHECK(mean_of(render_scene(scene, options).image) ==
              Approx(0.5 / PI * irradiance).epsilon(5e-3));
        // The ground divides by the same.
        scene.environment.ground = 0.0f;
        CHECK(double(ground_share(scene).x) == Approx(1 / irradiance).epsilon(1e-4));
        scene.environment.ground.reset();
    }
}

TEST_CASE("a camera sees the sun's disk, before a transparent background it does not") {
    Scene scene = doctor::lights::sphere_scene(false);
    scene.materials[0].emission = glm::vec3(0);
    scene.spheres[0].center = {0, 0, 50}; // behind
    scene.directional_lights = {sun_at(30, 2)};
    const glm::vec3 to = scene.directional_lights[0].to_light;
    scene.cameras = {camera_at({0, 0, 0}, to, float(radians(1)))}; // within the disk
    const double sine = std::sin(radians(1)), radiance = 2 / (PI * sine * sine);
    RenderOptions options = small_options(8, 8, 4);
    CHECK(mean_of(render_scene(scene, options).image) == Approx(radiance).epsilon(1e-4));
    options.background = Background::transparent;
    options.aovs = 1u << AOV_ALPHA;
    CHECK(std::ranges::max(render_scene(scene, options).image.pixels) == 0.0f);
    options.background = Background::environment;
    scene.cameras = {camera_at({0, 0, 0}, -to, float(radians(1)))};
    CHECK(std::ranges::max(render_scene(scene, options).image.pixels) == 0.0f);
}

TEST_CASE("a sun lights balls as a map with its disk does") {
    Scene scene = balls();
    scene.directional_lights = {sun_at(50, 12)};
    Scene mapped = balls();
    mapped.environment.radiance = glm::vec3(1);
    mapped.environment.map = map_of(scene.directional_lights[0]);
    RenderOptions options = small_options(48, 36, 512);
    options.depth = 4;
    const double own = mean_of(render_scene(scene, options).image);
    CHECK(own == Approx(mean_of(render_scene(mapped, options).image)).epsilon(0.005));
}

TEST_CASE("light tracing draws suns and measured lamps as paths from the camera do") {
    Scene scene = balls();
    scene.directional_lights = {sun_at(35, 3), sun_at(60, 25, {0.2f, 0.3f, 0.4f})};
    scene.photometric_lights = {doctor::lights::lopsided_lamp({1, 3, 1}, 20)};
    scene.photometric_lights[0].back = glm::normalize(glm::vec3(0.2f, 1, 0.3f));
    scene.environment.radiance = glm::vec3(0.05f);
    RenderOptions options = small_options(48, 40, 256);
    options.depth = 3;
    check_paths_agree(scene, options, 0.01);
    scene.cameras[0].orthographic_height = 4;
    check_paths_agree(scene, options, 0.01);
}

TEST_CASE("light tracing shows parallel rays what stands where they look") {
    Scene scene = balls();
    scene.environment.radiance = glm::vec3(0.25f);
    scene.directional_lights = {sun_at(30, 20)};
    const glm::vec3 to = scene.directional_lights[0].to_light;
    scene.cameras = {camera_at(glm::vec3(0, 6, 0), glm::vec3(0, 6, 0) + to, 0.5f)};
    scene.cameras[0].orthographic_height = 2;
    RenderOptions options = small_options(16, 16, 64);
    const double sine = std::sin(radians(10)), radiance = 2 / (PI * sine * sine) + 0.25;
    CHECK(mean_of(render_scene(scene, options).image) == Approx(radiance).epsilon(1e-4));
    const DeviceScene placed = place_on_device(scene);
    CHECK(mean_of(trace_light(placed, scene, options).image) == Approx(radiance).epsilon(0.02));
}

TEST_CASE("every width traces suns and measured lamps with the same bits") {
    const Scene scene = doctor::lights::every_light();
    Scene seen = scene;
    seen.cameras = {camera_at({0, 0, 8}, {0, 0, 0}, 0.9f)};
    const DeviceScene placed = place_on_device(seen);
    RenderOptions options = small_options(40, 28, 8);
    const Picture paths = render_by(seen, placed, apply(options, VARIANTS[0]));
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        CHECK(first_difference(paths.image,
                               render_by(seen, placed, apply(options, variant)).image) == "");
    }
    options.settings.width = 1;
    const Image traced = trace_light(placed, seen, options).image;
    CHECK(mean_of(traced) > 0);
    for (const uint32_t width : {8u, 16u}) {
        options.settings.width = width;
        CHECK(first_difference(traced, trace_light(placed, seen, options).image) == "");
    }
}

TEST_CASE("the light of suns belongs to their groups, seen or cast") {
    Scene scene = balls();
    scene.directional_lights = {sun_at(50, 10), sun_at(20, 10, {0, 1, 0})};
    scene.directional_lights[0].group = "high";
    scene.directional_lights[1].group = "low";
    RenderOptions options = small_options(24, 18, 64);
    options.light_groups = light_groups(scene);
    Session session(programs(), scene, {.render = options, .choose_layout = false});
    session.render();
    const std::vector<Image> groups = session.light_groups();
    const auto of = [&](const char* name) {
        const auto at = std::ranges::find(options.light_groups, name);
        REQUIRE(at != options.light_groups.end());
        return groups.at(size_t(at - options.light_groups.begin()));
    };
    CHECK(mean_of(of("high")) > 0);
    double red = 0, green = 0;
    const Image low = of("low");
    for (size_t i = 0; i < low.pixels.size(); i += 3) {
        red += double(low.pixels[i]);
        green += double(low.pixels[i + 1]);
    }
    CHECK(red == 0);
    CHECK(green > 0);
}

} // namespace onde::test
