// The ground that shows a scene's shadow and reflection only.
#include "render/picture.h"
#include "render/variants.h"
#include "upload/ground.h"

#include <cmath>
#include <numbers>

namespace onde::test {
namespace {

constexpr float RADIUS = 0.8f, HEIGHT = 1.0f;

/// A black ball above the ground y = 0, and a camera that sees the point below its middle.
Scene ball_above_ground() {
    Scene scene;
    Material black;
    black.kind = MaterialKind::diffuse;
    black.base_color = glm::vec3(0);
    scene.materials = {black};
    scene.spheres = {{{0, HEIGHT, 0}, RADIUS, 0}};
    scene.environment.radiance = {0.5f, 1, 2};
    scene.environment.ground = 0.0f;
    scene.cameras = {camera_at({2, 0.1f, 0}, {0, 0, 0}, 0.002f)};
    return scene;
}

glm::dvec3 mean_of(const Image& image) {
    glm::dvec3 sum(0);
    for (size_t i = 0; i < image.pixels.size(); i += image.channels)
        for (glm::length_t k = 0; k < 3; k++) sum[k] += image.pixels[i + size_t(k)];
    return sum / (double(image.pixels.size()) / image.channels);
}

} // namespace

TEST_CASE("a ball keeps the square of its sine from the ground below it") {
    // Form factor of a sphere and a plane element that faces it: sin^2 of its half angle.
    const double left = 1 - RADIUS * RADIUS / (HEIGHT * HEIGHT);
    const Image image = render_scene(ball_above_ground(), small_options(16, 16, 256)).image;
    const glm::dvec3 mean = mean_of(image);
    CHECK(mean.x == Approx(0.5 * left).epsilon(0.02));
    CHECK(mean.y == Approx(1.0 * left).epsilon(0.02));
    CHECK(mean.z == Approx(2.0 * left).epsilon(0.02));
}

TEST_CASE("the shadow of a directional light keeps that light's share from the ground") {
    Scene scene = ball_above_ground();
    scene.environment.radiance = glm::vec3(1 / std::numbers::pi_v<float>); // irradiance 1
    scene.spheres[0].radius = 0.05f;                                       // 0.0025 of that
    scene.directional_lights = {{{0, 1, 0}, glm::vec3(3)}};
    const glm::dvec3 mean = mean_of(render_scene(scene, small_options(16, 16, 256)).image);
    const double left = 1 - (3 + 0.0025) / 4;
    CHECK(mean.x * std::numbers::pi == Approx(left).epsilon(0.05));
}

TEST_CASE("before a transparent background the shadow is alpha, and nothing else is seen") {
    RenderOptions options = small_options(16, 16, 256);
    options.background = Background::transparent;
    options.aovs = 1u << AOV_ALPHA;
    const Image image = render_scene(ball_above_ground(), options).image;
    double alpha = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 4) {
        CHECK(image.pixels[i] == 0.0f);
        alpha += image.pixels[i + 3];
    }
    CHECK(alpha / 256 == Approx(RADIUS * RADIUS).epsilon(0.02));
}

TEST_CASE("a noisy shadow neither covers more than all nor leaves less than no light") {
    Scene scene = ball_above_ground();
    scene.environment.map = Image(8, 4, 3); // dim but for one spot near the horizon
    for (float& value : scene.environment.map->pixels) value = 0.2f;
    for (uint32_t k = 0; k < 3; k++) scene.environment.map->pixel(2, 1)[k] = 2.0f;
    scene.spheres[0].radius = 0.95f;
    RenderOptions options = small_options(16, 16, 2);
    options.aovs = 1u << AOV_ALPHA;
    const Image opaque = render_scene(scene, options).image;
    CHECK(std::ranges::min(opaque.pixels) == 0.0f);
    options.background = Background::transparent;
    const Image image = render_scene(scene, options).image;
    size_t full = 0;
    for (size_t i = 3; i < image.pixels.size(); i += 4) {
        CHECK((image.pixels[i] >= 0.0f && image.pixels[i] <= 1.0f));
        full += image.pixels[i] == 1.0f;
    }
    CHECK(full > 10); // they had more
}

TEST_CASE("ground that nothing shades shows the environment as it is, and so does the other side") {
    Scene scene = ball_above_ground();
    scene.cameras[0] = camera_at({200, 1, 0}, {195, 0, 0}, 0.1f);
    const Image far = render_scene(scene, small_options(8, 8, 4)).image;
    CHECK(mean_of(far).y == Approx(1.0).epsilon(1e-3));
    scene.cameras[0] = camera_at({2, -1, 0}, {0, HEIGHT, 0}, 0.002f);
    const glm::dvec3 below = mean_of(render_scene(scene, small_options(8, 8, 4)).image);
    CHECK(below.y == 0.0); // the black ball, through the plane
}

TEST_CASE("the ground reflects what shines, by Fresnel's share, but not the environment") {
    Scene scene = ball_above_ground();
    scene.materials[0].emission = glm::vec3(10);
    scene.environment.radiance = glm::vec3(1e-3f);
    // Looked at from 30 degrees above, the reflection sees the middle of a large ball behind.
    scene.spheres = {{{-5, 5 * std::tan(0.5236f), 0}, 2.4f, 0}};
    scene.cameras[0] = camera_at({2, 2 * std::tan(0.5236f), 0}, {0, 0, 0}, 0.002f);
    const double cosine = std::sin(0.5236), sine2 = 1 - cosine * cosine, n = 1.5;
    const double t = std::sqrt(1 - sine2 / (n * n));
    const double p = (n * cosine - t) / (n * cosine + t), s = (cosine - n * t) / (cosine + n * t);
    const double wanted = 10 * 0.5 * (p * p + s * s);
    const glm::dvec3 mean = mean_of(render_scene(scene, small_options(16, 16, 256)).image);
    CHECK(mean.x == Approx(wanted).epsilon(0.05));
}

TEST_CASE("the ground is the same bits by every engine") {
    const Scene scene = [] {
        Scene seen = ball_above_ground();
        seen.materials[0].base_color = glm::vec3(0.7f);
        seen.cameras = {camera_at({3, 2, 3}, {0, 0.5f, 0}, 0.9f)};
        return seen;
    }();
    const Picture first = render_scene(scene, apply(small_options(24, 16, 4), VARIANTS[0]));
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        const Picture picture = render_scene(scene, apply(small_options(24, 16, 4), variant));
        CHECK(first_difference(first.image, picture.image) == "");
        CHECK(picture.rays.shadow == first.rays.shadow);
    }
}

TEST_CASE("a ground's light is the upper half of the environment, and directions from above") {
    Scene scene = ball_above_ground();
    scene.environment.radiance = glm::vec3(2);
    scene.environment.map = Image(8, 4, 3);
    for (uint32_t x = 0; x < 8; x++)
        for (uint32_t k = 0; k < 3; k++) scene.environment.map->pixel(x, 0)[k] = 1;
    // The uppermost of four rows is a cap of 45 degrees: pi sin^2.
    CHECK(ground_share(scene).x == Approx(1 / (2 * std::numbers::pi * 0.5)));
    scene.directional_lights = {{{0, 0.6f, 0.8f}, glm::vec3(1)}, {{0, -1, 0}, glm::vec3(9)}};
    CHECK(ground_share(scene).x == Approx(1 / (2 * std::numbers::pi * 0.5 + 0.6)));
    scene.environment.ground.reset();
    CHECK(ground_share(scene) == glm::vec3(0));
}

} // namespace onde::test
