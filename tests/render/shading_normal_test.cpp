// Shading normals that differ from the surface's own.
#include "render/faceted_ball.h"
#include "render/picture.h"

namespace onde::test {
namespace {

/// A mirror of few triangles with the normals of a ball, which reflects a half of a white world.
Scene mirror_ball() {
    Scene scene;
    Mesh mesh = faceted_ball(10, 6);
    mesh.normals = mesh.positions;
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
