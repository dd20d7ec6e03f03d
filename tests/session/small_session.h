// A small scene with one of everything, in sessions whose programs all tests share.
#pragma once

#include "scene/load.h"
#include "scene/shapes.h"
#include "session/session.h"
#include "support/all_features.h"
#include "support/programs.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace onde::test {

inline glm::mat4 moved(glm::vec3 by) {
    return glm::translate(glm::mat4(1.0f), by);
}

/// A square of 2 x 2 about the origin, facing +Y, of 2 * cells * cells triangles.
inline Mesh grid_mesh(uint32_t cells, uint32_t material) {
    Mesh mesh;
    for (uint32_t z = 0; z <= cells; ++z)
        for (uint32_t x = 0; x <= cells; ++x)
            mesh.positions.emplace_back(2.0f * float(x) / float(cells) - 1.0f, 0.0f,
                                        2.0f * float(z) / float(cells) - 1.0f);
    for (uint32_t z = 0; z < cells; ++z)
        for (uint32_t x = 0; x < cells; ++x) {
            const uint32_t a = z * (cells + 1) + x, b = a + cells + 1;
            mesh.triangles.emplace_back(a, b, a + 1);
            mesh.triangles.emplace_back(a + 1, b, b + 1);
        }
    mesh.materials.resize(mesh.triangles.size(), material);
    return mesh;
}

// Of varied_scene().
inline constexpr size_t FLOOR = 0, FIRST_TILE = 1, SECOND_TILE = 2, LAMP = 3; // instances
inline constexpr size_t WHITE = 0, RED = 1, GLOW = 2;                         // materials

/// A floor that is baked, two instances of a fine grid, a lamp of two triangles, a ball and a
/// torus.
inline Scene varied_scene() {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[RED].base_color = glm::vec3(0.8f, 0.1f, 0.1f);
    scene.materials[GLOW].emission = glm::vec3(4.0f);
    scene.meshes = {grid_mesh(1, WHITE), grid_mesh(33, RED), grid_mesh(1, GLOW)};
    const glm::mat4 floor = glm::scale(glm::mat4(1.0f), glm::vec3(5.0f));
    const glm::mat4 lamp = glm::rotate(moved({0, 4, 0}), 3.0f, glm::vec3(1, 0, 0));
    scene.instances = {
        {0, floor}, {1, moved({-1.2f, 0.5f, 0})}, {1, moved({1.2f, 1, -1})}, {2, lamp}};
    scene.spheres = {{{0, 0.6f, 1}, 0.6f, RED}};
    scene.shapes = {{ShapeKind::torus, WHITE, 0.3f, moved({0, 1.5f, 0})}};
    scene.environment.radiance = glm::vec3(0.2f, 0.3f, 0.4f);
    complete_scene(scene);
    check_scene(scene);
    return scene;
}

/// Kernels that can do everything, so that all scenes share one program for each integrator.
inline SessionOptions small_session(IntegratorKind integrator = IntegratorKind::path,
                                    uint32_t samples = 2) {
    SessionOptions options;
    options.render.width = 40;
    options.render.height = 30;
    options.render.samples = samples;
    options.render.depth = 4;
    options.render.integrator = integrator;
    options.render.settings = gpu::default_settings(device().facts());
    options.features = all_features();
    return options;
}

inline constexpr IntegratorKind ALL_INTEGRATORS[] = {
    IntegratorKind::path, IntegratorKind::whitted, IntegratorKind::light,
    IntegratorKind::depth_buffer, IntegratorKind::painter};

inline std::vector<float> rendered(Session& session) {
    session.render();
    return session.picture().pixels;
}

/// What a new session makes of a scene.
inline std::vector<float> fresh_picture(const Scene& scene, const SessionOptions& options) {
    Session session(programs(), scene, options);
    return rendered(session);
}

} // namespace onde::test
