// How lights are sampled changes the noise of a picture, never its mean, and never which engine
// makes which bits.
#include "doctor/light_rig.h"
#include "render/picture.h"
#include "render/variants.h"

#include <cmath>
#include <numeric>

namespace onde::test {
namespace {

using doctor::Generator;
using doctor::unit;

/// The mean over a picture, over seeds.
struct Mean {
    double value = 0, variance = 0;
};

Mean mean_of(const Scene& scene, RenderOptions options, const LightOptions& lights) {
    constexpr uint32_t SEEDS = 16;
    Session session(programs(), scene, {.render = options, .lights = lights});
    double sum = 0, squares = 0;
    for (options.seed = 1; options.seed <= SEEDS; options.seed++) {
        session.set_options(options);
        session.render();
        const std::vector<float> pixels = session.picture().pixels;
        const double mean =
            std::accumulate(pixels.begin(), pixels.end(), 0.0) / double(pixels.size());
        sum += mean / SEEDS;
        squares += mean * mean / SEEDS;
    }
    return {sum, std::max(squares - sum * sum, 0.0) / (SEEDS - 1)};
}

/// Student's t of 30 degrees is beyond 4.5 once in ten thousand times.
void check_same(const Mean& a, const Mean& b) {
    INFO(a.value << " and " << b.value);
    CHECK(std::abs(a.value - b.value) < 4.5 * std::sqrt(a.variance + b.variance) + 1e-6 * a.value);
    CHECK(std::sqrt(a.variance + b.variance) < 0.015 * a.value); // else it says little
}

Material rough(float metallic, float roughness) {
    Material material;
    material.kind = MaterialKind::metallic_roughness;
    material.base_color = {0.9f, 0.6f, 0.3f};
    material.metallic = metallic;
    material.roughness = roughness;
    return material;
}

/// Balls of all kinds on a floor, lit by a sky with a little sun, black below.
Scene under_a_sky() {
    Scene scene;
    scene.materials = {rough(0, 1), rough(1, 0.3f), rough(0.2f, 0.6f), Material{}};
    scene.materials[3].kind = MaterialKind::dielectric;
    doctor::add_triangle(scene, {-9, 0, 9}, {9, 0, 9}, {0, 0, -9}, rough(0, 0.8f));
    for (uint32_t i = 0; i < 4; i++)
        scene.spheres.push_back({{float(i) - 1.5f, 0.45f, 0}, 0.45f, i});
    Image map(32, 16, 3);
    for (uint32_t y = 0; y < 8; y++)
        for (uint32_t x = 0; x < 32; x++)
            std::ranges::fill(map.pixel(x, y), 0.1f + 0.05f * float(y) + 0.01f * float(x));
    std::ranges::fill(map.pixel(10, 4), 40.0f);
    scene.environment.radiance = glm::vec3(1);
    scene.environment.map = std::move(map);
    scene.cameras = {camera_at({0, 2, 5}, {0, 0.4f, 0}, 0.6f)};
    return scene;
}

/// Many little lights of all types around balls on a floor.
Scene among_lights() {
    Scene scene = doctor::lights::many_lights(100, 6);
    for (uint32_t i = 0; i < 3; i++) {
        scene.spheres.push_back(
            {{1.5f + float(i), 1.5f, 3}, 0.5f, uint32_t(scene.materials.size())});
        scene.materials.push_back(rough(float(i) / 2, 0.3f + 0.3f * float(i)));
    }
    doctor::add_triangle(scene, {-9, 1, 9}, {9, 1, 9}, {0, 1, -9}, rough(0, 0.8f));
    scene.cameras = {camera_at({3, 4, 9}, {3, 1.5f, 3}, 0.6f)};
    return scene;
}

} // namespace

TEST_CASE("compensated samples of a sky change no mean, at a path's last surface neither") {
    const Scene scene = under_a_sky();
    for (const uint32_t depth : {2u, 5u}) {
        RenderOptions options = small_options(32, 24, 64);
        options.depth = depth;
        const Mean whole = mean_of(scene, options, {.compensation = 0});
        for (const double share : {0.5, 1.0}) {
            INFO("depth " << depth << ", compensated by " << share << " of the mean");
            check_same(whole, mean_of(scene, options, {.compensation = share}));
        }
    }
}

TEST_CASE("the ground of a model is shaded by the whole of the sky, compensated or not") {
    Scene scene = under_a_sky();
    scene.meshes.clear();
    scene.instances.clear();
    scene.environment.ground = 0.0f;
    scene.environment.map->pixel(10, 4)[1] = 8.0f;
    const RenderOptions options = small_options(32, 24, 64);
    check_same(mean_of(scene, options, {.compensation = 0}),
               mean_of(scene, options, {.compensation = 1}));
}

TEST_CASE("the light tree changes no mean") {
    Scene scene = among_lights();
    for (const bool smooth : {false, true}) {
        INFO((smooth ? "with" : "without") << " glass");
        if (smooth) scene.materials[scene.spheres.back().material].kind = MaterialKind::dielectric;
        const RenderOptions options = small_options(32, 24, 64);
        check_same(mean_of(scene, options, {.sampler = LightSampler::power}),
                   mean_of(scene, options, {.sampler = LightSampler::tree}));
    }
}

TEST_CASE("every engine, width and launch samples many lights with the same bits") {
    const Scene scene = among_lights();
    const DeviceScene placed = place_on_device(scene);
    REQUIRE(placed.packed().features.light_tree);
    RenderOptions options = small_options(40, 28, 3);
    options.aovs = 1u << AOV_DENOISE_NORMAL | 1u << AOV_DIRECT;
    const Picture expected = render_by(scene, placed, apply(options, VARIANTS[0]));
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        const Picture picture = render_by(scene, placed, apply(options, variant));
        CHECK(first_difference(expected.image, picture.image) == "");
        CHECK(expected.rays.shadow == picture.rays.shadow);
        CHECK(picture.invalid.count == 0);
    }
}

} // namespace onde::test
