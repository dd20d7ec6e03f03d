// Media that are as dense as a grid says, against closed forms, quadrature and what is the same
// everywhere.
#include "render/media_scenes.h"
#include "scene/load_context.h"

#include <functional>
#include <random>

namespace onde::test {
namespace {

using DensityAlong = std::function<double(double share)>; ///< of the way into a slab

/// Samples from one end of the slab to the other, of which the density is linear in between.
DensityGrid grid_along(const DensityAlong& density, uint32_t steps, float depth) {
    LoadContext context;
    DensityGrid grid = make_grid(context, "test", {2, 2, steps + 1}, [&](const glm::uvec3& p) {
        return float(density(double(p.z) / steps));
    });
    // Samples from z = 0 down to -depth.
    const glm::mat4 place = glm::translate(glm::mat4(1.0f), glm::vec3(-1.5f, -1.5f, 0));
    grid.from_samples = glm::scale(place, glm::vec3(3, 3, -depth / float(steps)));
    return grid;
}

Scene slab_along(Medium medium, const DensityAlong& density, uint32_t steps, float depth) {
    medium.grid = 0;
    Scene scene = slab(medium, depth);
    scene.grids = {grid_along(density, steps, depth)};
    return scene;
}

/// Densities in [0, 1] that know nothing of each other, in a box about a ball of radius 1.
DensityGrid noise_grid(uint32_t cells) {
    LoadContext context;
    std::minstd_rand random(3);
    std::uniform_real_distribution<float> any(0.0f, 1.0f);
    std::vector<float> densities(size_t(cells) * cells * cells);
    for (float& density : densities) density = any(random);
    return make_cell_grid(context, "test", glm::uvec3(cells), densities, glm::dvec3(-1.25),
                          glm::dvec3(1.25));
}

double even(double) {
    return 1.0;
}
double ramp(double share) {
    return 2.0 * share;
}
/// Nothing, then as much as there is.
double step(double share) {
    return share < 0.5 ? 0.0 : 2.0;
}

/// Half of it lies in the plane between two bricks.
constexpr uint32_t STEPS = 32;

} // namespace

TEST_CASE("a grid that only absorbs leaves what the sum of its densities says") {
    const glm::vec3 rate(0.5f, 1.0f, 3.0f);
    for (const DensityAlong& density : {DensityAlong(even), DensityAlong(ramp)}) {
        Scene scene = slab_along({.absorption = rate}, density, STEPS, 0.8f);
        scene.environment.radiance = glm::vec3(1);
        const Seen all = seen(scene, 4096, 8);
        check_near(all.mean, glm::exp(-glm::dvec3(rate) * 0.8), 5 * glm::length(all.error) + 1e-4);
    }
    // The slope of the step is one cell, from 15/32 to 16/32.
    Scene scene = slab_along({.absorption = rate}, step, STEPS, 0.8f);
    scene.environment.radiance = glm::vec3(1);
    const Seen all = seen(scene, 4096, 8);
    check_near(all.mean, glm::exp(-glm::dvec3(rate) * 0.8 * 33.0 / 32.0),
               5 * glm::length(all.error) + 1e-4);
}

TEST_CASE("light that goes through a grid to a surface is dimmed without bias") {
    const glm::vec3 rate(0.5f, 1.0f, 3.0f);
    Scene room = doctor::floor_seen_from_above(0.5f);
    room.medium = {.absorption = rate, .grid = 0};
    // Between the light at 3 and the camera at 0.5, from 2.5 down to 0.7.
    room.grids = {grid_along(ramp, STEPS, 1.8f)};
    room.medium.placement = glm::translate(glm::mat4(1.0f), glm::vec3(0, 2.5f, 0)) *
                            glm::rotate(glm::mat4(1.0f), glm::radians(-90.0f), glm::vec3(1, 0, 0));
    PointLight bulb;
    bulb.position = {0, 3, 0};
    bulb.intensity = glm::vec3(9);
    room.point_lights.push_back(bulb);
    const Seen all = seen(room, 4096, 2);
    check_near(all.mean, glm::exp(-glm::dvec3(rate) * 1.8) * (0.5 / M_PI),
               5 * glm::length(all.error) + 1e-4);
}

TEST_CASE("light that a grid scatters once is what quadrature finds") {
    const glm::dvec3 absorbed(0.2, 0.5, 0.1), scattered(0.8, 0.3, 1.9);
    const double depth = 1.5, cosine = 0.8, g = 0.6;
    for (const DensityAlong& density : {DensityAlong(even), DensityAlong(ramp)}) {
        Scene scene = slab_along({.absorption = glm::vec3(absorbed),
                                  .scattering = glm::vec3(scattered),
                                  .anisotropy = float(g)},
                                 density, STEPS, float(depth));
        DirectionalLight sun; // from behind the camera, slanted
        sun.to_light = glm::vec3(std::sqrt(1 - cosine * cosine), 0, cosine);
        sun.irradiance = glm::vec3(2);
        scene.directional_lights.push_back(sun);
        const Seen once = seen(scene, 4096, 3); // the boundary, what scatters, the boundary
        constexpr int COUNT = 4096;
        glm::dvec3 wanted(0.0);
        double before = 0.0; // the sum of densities
        for (int i = 0; i < COUNT; i++) {
            const double piece = density((i + 0.5) / COUNT) * depth / COUNT;
            const glm::dvec3 rate = (absorbed + scattered) * (1 + 1 / cosine);
            wanted += scattered * piece * glm::exp(-rate * (before + 0.5 * piece));
            before += piece;
        }
        wanted *= 2 * phase(-cosine, g);
        check_near(once.mean, wanted, 5 * glm::length(once.error) + 2e-4);
    }
}

TEST_CASE("a grid of one density is the medium without it") {
    Medium medium{.absorption = glm::vec3(0.1f, 0.4f, 0.2f),
                  .scattering = glm::vec3(2, 1, 3),
                  .emission = glm::vec3(0.3f, 0.1f, 0),
                  .anisotropy = 0.5f};
    Scene plain = doctor::furnace(boundary(medium));
    doctor::add_square_light(plain, 1.0f, 3.0f, 5.0f);
    plain.environment.radiance = glm::vec3(0.2f);
    Scene gridded = plain;
    LoadContext context;
    gridded.grids = {make_cell_grid(context, "test", {9, 5, 17},
                                    std::vector<float>(9 * 5 * 17, 0.25f), glm::dvec3(-2),
                                    glm::dvec3(2))};
    gridded.materials[0].medium->grid = 0;
    gridded.materials[0].medium->density_scale = 4.0f;
    const Seen a = seen(plain, 256, 64), b = seen(gridded, 256, 64);
    check_near(b.mean, a.mean, 5 * glm::length(a.error + b.error) + 1e-4);
}

TEST_CASE("what a grid scatters without absorbing takes nothing from a white world") {
    for (const glm::vec3 rate : {glm::vec3(3.0f), glm::vec3(20, 6, 0.5f)}) {
        Scene scene =
            doctor::furnace(boundary({.scattering = rate, .anisotropy = 0.3f, .grid = 0}));
        scene.grids = {noise_grid(21)};
        check_white(seen(scene, 64, 512, 32));
    }
}

TEST_CASE("a grid that glows as it absorbs of a white world is not seen in it") {
    for (const glm::vec3 scattering : {glm::vec3(0.0f), glm::vec3(2, 6, 0.5f)}) {
        Scene scene = doctor::furnace(boundary({.absorption = glm::vec3(0.5f, 0, 3),
                                                .scattering = scattering,
                                                .emission = glm::vec3(0.5f, 0, 3),
                                                .grid = 0}));
        scene.grids = {noise_grid(21)};
        check_white(seen(scene, 256, 256, 32));
    }
}

TEST_CASE("what glows without absorbing adds the sum of its densities") {
    const Scene scene = slab_along({.emission = glm::vec3(0.7f, 0, 1.5f)}, ramp, STEPS, 0.8f);
    const Seen all = seen(scene, 1024, 8);
    check_near(all.mean, glm::dvec3(0.7, 0, 1.5) * 0.8, 5 * glm::length(all.error) + 1e-4);
}

TEST_CASE("a grid lies where it is placed, turned and scaled") {
    Scene scene = slab_along({.absorption = glm::vec3(1)}, ramp, STEPS, 0.8f);
    scene.environment.radiance = glm::vec3(1);
    // Half as deep, and turned around: its dense end in front.
    auto& medium = *scene.materials[0].medium;
    medium.placement = glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -0.8f)) *
                       glm::rotate(glm::mat4(1.0f), glm::radians(180.0f), glm::vec3(0, 1, 0)) *
                       glm::scale(glm::mat4(1.0f), glm::vec3(1, 1, 0.5f));
    Material black = doctor::furnace_material(MaterialKind::diffuse, glm::vec3(0), 1);
    black.emission = glm::vec3(1); // in the middle of what is left
    scene.materials.push_back(black);
    scene.meshes.push_back(box_mesh(glm::vec3(4, 4, 0.01f), 1));
    scene.instances.push_back({1, glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -0.605f))});
    const Seen all = seen(scene, 1024, 8);
    // From -0.4 to -0.6, where the density falls from 2 to 1.
    check_near(all.mean, glm::dvec3(std::exp(-0.2 * 1.5)), 5 * glm::length(all.error) + 1e-3);
}

TEST_CASE("grids have the same bits in all engines and lanes, and no invalid samples") {
    Scene scene = doctor::furnace(boundary({.absorption = glm::vec3(0.1f),
                                            .scattering = glm::vec3(5, 2, 3),
                                            .emission = glm::vec3(0.2f, 0, 0.1f),
                                            .anisotropy = 0.5f,
                                            .grid = 0}));
    doctor::add_square_light(scene, 1.0f, 3.0f, 5.0f);
    scene.grids = {noise_grid(21)};
    scene.medium = {.absorption = glm::vec3(0.3f, 0.2f, 0.1f), .grid = 0};
    scene.medium.placement = glm::scale(glm::mat4(1.0f), glm::vec3(2, 1, 1.5f));
    scene.environment.radiance = glm::vec3(0);
    RenderOptions options = small_options(16, 16, 4);
    options.depth = 8;
    check_same_bits(scene, options);
    const Picture picture = render_scene(scene, options);
    CHECK(picture.invalid.count == 0);
}

} // namespace onde::test
