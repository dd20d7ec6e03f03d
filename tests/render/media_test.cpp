// What light meets on its way: absorption and scattering by what is inside of things and around.
#include "render/same_bits.h"

#include <glm/gtc/matrix_transform.hpp>

namespace onde::test {
namespace {

/// The boundary of a medium that bends no light.
Material boundary(const Medium& medium) {
    Material material = doctor::furnace_material(MaterialKind::dielectric, glm::vec3(1), 0);
    material.ior = 1;
    material.medium = medium;
    return material;
}

/// The mean of each channel, and its standard error by the pixels.
struct Seen {
    glm::dvec3 mean{0}, error{0};
    explicit Seen(const Image& image) {
        const size_t count = image.pixels.size() / image.channels;
        glm::dvec3 squares(0);
        for (size_t i = 0; i < count; i++) {
            const float* pixel = &image.pixels[i * image.channels];
            const glm::dvec3 value(pixel[0], pixel[1], pixel[2]);
            mean += value / double(count);
            squares += value * value / double(count);
        }
        error = glm::sqrt(glm::max(squares - mean * mean, 0.0) / double(count));
    }
};

Seen seen(const Scene& scene, uint32_t samples, uint32_t depth, uint32_t size = 16) {
    RenderOptions options = small_options(size, size, samples);
    options.depth = depth;
    return Seen(render_scene(scene, options).image);
}

void check_near(const glm::dvec3& got, const glm::dvec3& wanted, double margin) {
    INFO(got.x << " " << got.y << " " << got.z << ", wanted " << wanted.x << " " << wanted.y << " "
               << wanted.z);
    CHECK(glm::length(got - wanted) < margin);
}

void check_white(const Seen& all) {
    for (glm::length_t c = 0; c < 3; c++) {
        INFO("channel " << c << ": " << all.mean[c] << " within " << all.error[c]);
        CHECK(all.error[c] < 0.01);
        CHECK(std::abs(all.mean[c] - 1) < 2e-4 + 4 * all.error[c]);
    }
}

double phase(double cosine, double g) {
    return (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// A slab from z = 0 to -depth, seen by parallel rays along -z.
Scene slab(const Medium& medium, float depth) {
    Scene scene;
    scene.materials = {boundary(medium)};
    scene.meshes = {box_mesh(glm::vec3(3, 3, depth), 0)};
    scene.instances = {{0, glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -0.5f * depth))}};
    scene.cameras = {camera_at({0, 0, 5}, {0, 0, 0}, 0.1f)};
    scene.cameras[0].orthographic_height = 1.0f;
    return scene;
}

} // namespace

TEST_CASE("what scatters without absorbing takes nothing from a white world") {
    for (const float g : {-0.5f, 0.0f, 0.8f})
        for (const glm::vec3 rate : {glm::vec3(0.3f), glm::vec3(2, 1, 0.2f)}) {
            INFO("rates " << rate.x << " " << rate.z << ", g " << g);
            const Scene scene = doctor::furnace(boundary({glm::vec3(0), rate, g}));
            const Seen all = seen(scene, 64, 256, 32);
            check_white(all);
        }
}

TEST_CASE("in a glowing box fog that scatters changes nothing, found by sampling lights or not") {
    Scene scene = doctor::glowing_box(glm::vec3(0.5f));
    scene.medium.scattering = glm::vec3(0.7f, 0.4f, 1.5f);
    scene.medium.anisotropy = 0.4f;
    const Seen all = seen(scene, 256, 256);
    check_white(all);
}

TEST_CASE("what absorbs leaves as much as the way through it says") {
    const glm::vec3 rate(0.5f, 1.0f, 3.0f);
    Scene scene = slab({rate, glm::vec3(0), 0}, 0.8f);
    scene.environment.radiance = glm::vec3(1);
    check_near(seen(scene, 4, 8).mean, glm::exp(-glm::dvec3(rate) * 0.8), 1e-4);

    // With coloured glass beside it, and of what is around everything: both lights are 3 away.
    scene.materials[0].attenuation_color = glm::vec3(0.5f, 0.25f, 1.0f);
    scene.materials[0].attenuation_distance = 0.8f;
    check_near(seen(scene, 4, 8).mean, glm::exp(-glm::dvec3(rate) * 0.8) * glm::dvec3(0.5, 0.25, 1),
               1e-4);
    Scene room = doctor::floor_seen_from_above(0.5f); // from a height of 0.5
    room.medium.absorption = rate;
    PointLight bulb;
    bulb.position = {0, 3, 0};
    bulb.intensity = glm::vec3(9);
    room.point_lights.push_back(bulb);
    check_near(seen(room, 4, 2).mean, glm::exp(-glm::dvec3(rate) * 3.5) * (0.5 / M_PI), 1e-4);
}

TEST_CASE("light that is scattered once comes back as the phase function and the rates say") {
    for (const float g : {0.0f, -0.6f, 0.7f}) {
        const glm::dvec3 absorbed(0.2, 0.5, 0.1), scattered(0.8, 0.3, 1.9);
        const float depth = 1.5f;
        Scene scene = slab({glm::vec3(absorbed), glm::vec3(scattered), g}, depth);
        DirectionalLight sun; // from behind the camera, slanted
        const double cosine = 0.8;
        sun.to_light = glm::vec3(std::sqrt(1 - cosine * cosine), 0, cosine);
        sun.irradiance = glm::vec3(2);
        scene.directional_lights.push_back(sun);
        const Seen once = seen(scene, 1024, 3, 32); // the boundary, what scatters, the boundary
        const glm::dvec3 rate = (absorbed + scattered) * (1 + 1 / cosine);
        const glm::dvec3 wanted = scattered * (2 * phase(-cosine, double(g))) *
                                  (1.0 - glm::exp(-rate * double(depth))) / rate;
        INFO("g " << g);
        check_near(once.mean, wanted, 6 * glm::length(once.error) + 1e-4);
    }
}

TEST_CASE("things in a medium, and glass in it, end where they should") {
    // A black ball in fog that only absorbs, in a white world: seen is what is left around it.
    Scene scene = slab({glm::vec3(0.7f), glm::vec3(0), 0}, 2.0f);
    scene.environment.radiance = glm::vec3(1);
    Material glow = doctor::furnace_material(MaterialKind::diffuse, glm::vec3(0), 1);
    glow.emission = glm::vec3(1);
    scene.materials.push_back(glow);
    scene.meshes.push_back(box_mesh(glm::vec3(4, 4, 0.5f), 1));
    scene.instances.push_back({1, glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -1.0f))});
    check_near(seen(scene, 4, 8).mean, glm::dvec3(std::exp(-0.7 * 0.75)), 1e-4);
    // A slab of clear glass of index 1 in its place: the fog is away where it is.
    scene.materials[1] = boundary({});
    check_near(seen(scene, 4, 8).mean, glm::dvec3(std::exp(-0.7 * 1.5)), 1e-4);
}

TEST_CASE("media have the same bits in all engines and lanes") {
    Scene scene = doctor::furnace(boundary({glm::vec3(0.1f), glm::vec3(1, 2, 3), 0.5f}));
    doctor::add_square_light(scene, 1.0f, 3.0f, 5.0f);
    scene.medium.scattering = glm::vec3(0.05f);
    scene.environment.radiance = glm::vec3(0);
    RenderOptions options = small_options(16, 16, 4);
    options.depth = 8;
    check_same_bits(scene, options);
}

TEST_CASE("media are for what is clear, and for the path tracer") {
    Scene opaque =
        doctor::furnace(doctor::furnace_material(MaterialKind::diffuse, glm::vec3(1), 1));
    opaque.materials[0].medium = Medium{};
    CHECK_THROWS_WITH(check_scene(opaque), Catch::Contains("medium needs a clear kind"));
    Scene fog = doctor::glowing_box(glm::vec3(0.5f));
    fog.medium.scattering = glm::vec3(1);
    RenderOptions options = small_options(8, 8, 1);
    options.integrator = IntegratorKind::light;
    CHECK_THROWS_WITH(render_scene(fog, options), Catch::Contains("knows no media"));
}

} // namespace onde::test
