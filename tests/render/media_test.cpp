// What light meets on its way: absorption and scattering by what is inside of things and around.
#include "render/media_scenes.h"

namespace onde::test {

TEST_CASE("what scatters without absorbing takes nothing from a white world") {
    for (const float g : {-0.5f, 0.0f, 0.8f})
        for (const glm::vec3 rate : {glm::vec3(0.3f), glm::vec3(2, 1, 0.2f)}) {
            INFO("rates " << rate.x << " " << rate.z << ", g " << g);
            const Scene scene = doctor::furnace(boundary({.scattering = rate, .anisotropy = g}));
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
    Scene scene = slab({.absorption = rate}, 0.8f);
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
        Scene scene = slab({.absorption = glm::vec3(absorbed),
                            .scattering = glm::vec3(scattered),
                            .anisotropy = g},
                           depth);
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
    Scene scene = slab({.absorption = glm::vec3(0.7f)}, 2.0f);
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

TEST_CASE("what glows adds as much as the way through it says") {
    const glm::dvec3 absorbed(0.0, 0.5, 3.0), glow(0.7, 0.2, 1.1);
    const double depth = 0.8;
    const Scene scene =
        slab({.absorption = glm::vec3(absorbed), .emission = glm::vec3(glow)}, float(depth));
    const glm::dvec3 far = 1.0 - glm::exp(-absorbed * depth);
    check_near(seen(scene, 4, 8).mean,
               {glow.x * depth, glow.y / absorbed.y * far.y, glow.z / absorbed.z * far.z}, 1e-4);
    // Around everything, to the wall and to where there is no end.
    Scene room = doctor::floor_seen_from_above(0.5f); // from a height of 0.5
    room.medium = {.absorption = glm::vec3(2), .emission = glm::vec3(0.6f)};
    check_near(seen(room, 4, 1).mean, glm::dvec3(0.3 * (1 - std::exp(-1.0))), 1e-4);
    Scene sky = slab({}, 0.1f);
    sky.cameras[0].camera_to_world = glm::translate(glm::mat4(1.0f), glm::vec3(0, 50, 0));
    sky.medium = room.medium;
    check_near(seen(sky, 4, 1).mean, glm::dvec3(0.3), 1e-5);
}

TEST_CASE("what glows as much as it absorbs of a white world is not seen in it") {
    for (const glm::vec3 scattering : {glm::vec3(0.0f), glm::vec3(2, 1, 0.2f)}) {
        const Medium medium{.absorption = glm::vec3(0.5f, 1.5f, 0.1f),
                            .scattering = scattering,
                            .emission = glm::vec3(0.5f, 1.5f, 0.1f),
                            .anisotropy = 0.4f};
        check_white(seen(doctor::furnace(boundary(medium)), 64, 256, 32));
    }
}

TEST_CASE("media have the same bits in all engines and lanes") {
    Scene scene = doctor::furnace(boundary({.absorption = glm::vec3(0.1f),
                                            .scattering = glm::vec3(1, 2, 3),
                                            .emission = glm::vec3(0.2f, 0, 0.1f),
                                            .anisotropy = 0.5f}));
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
    fog.medium.emission = glm::vec3(1);
    CHECK_THROWS_WITH(check_scene(fog), Catch::Contains("no end"));
    fog.medium.scattering = glm::vec3(1);
    RenderOptions options = small_options(8, 8, 1);
    options.integrator = IntegratorKind::light;
    CHECK_THROWS_WITH(render_scene(fog, options), Catch::Contains("knows no media"));
}

} // namespace onde::test
