// Shading normals that differ from the surface's own.
#include "render/picture.h"

#include <cmath>

namespace onde::test {
namespace {

/// A mirror of few triangles with the normals of a ball, which reflects a half of a white world.
Scene mirror_ball() {
    constexpr uint32_t COLUMNS = 10, ROWS = 6;
    Scene scene;
    Mesh mesh;
    const double pi = std::acos(-1.0);
    for (uint32_t j = 0; j <= ROWS; j++)
        for (uint32_t i = 0; i < COLUMNS; i++) {
            const double up = pi * j / ROWS, around = 2 * pi * i / COLUMNS;
            mesh.normals.push_back(glm::normalize(glm::vec3(
                std::sin(up) * std::cos(around), std::cos(up), std::sin(up) * std::sin(around))));
        }
    mesh.positions = mesh.normals;
    for (uint32_t j = 0; j < ROWS; j++)
        for (uint32_t i = 0; i < COLUMNS; i++) {
            const uint32_t a = j * COLUMNS + i, b = j * COLUMNS + (i + 1) % COLUMNS;
            mesh.triangles.emplace_back(a, b, a + COLUMNS);
            mesh.triangles.emplace_back(b, b + COLUMNS, a + COLUMNS);
        }
    mesh.materials.assign(mesh.triangles.size(), 0);
    Material material;
    material.kind = MaterialKind::conductor;
    material.base_color = glm::vec3(0.5f);
    material.roughness = 0;
    scene.materials = {material};
    scene.meshes = {mesh};
    scene.instances = {{0, glm::mat4(1)}};
    scene.environment.radiance = glm::vec3(1);
    scene.cameras = {camera_at({1, 2, 4}, {0, 0, 0}, 0.5f)};
    return scene;
}

} // namespace

TEST_CASE("a smooth mirror of few triangles reflects all of its rays, its rim too") {
    const Image image = render_scene(mirror_ball(), small_options(96, 96, 4)).image;
    size_t dark = 0, seen = 0;
    for (const float value : image.pixels) {
        dark += value < 0.4999f;
        seen += value < 0.75f;
    }
    CHECK(seen > 5000);
    CHECK(dark == 0);
}

} // namespace onde::test
