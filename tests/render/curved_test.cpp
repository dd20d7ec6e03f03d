// Light on triangles that stand for a curved surface: it fades out as on the surface itself.
#include "render/faceted_ball.h"
#include "render/picture.h"

#include <glm/gtc/matrix_transform.hpp>

namespace onde::test {
namespace {

constexpr uint32_t SIZE = 96;

/// A white thing at the origin under light from the right, seen from the front.
Scene lit_from_the_side() {
    Scene scene;
    Material material;
    material.kind = MaterialKind::diffuse;
    material.base_color = glm::vec3(1);
    scene.materials = {material};
    DirectionalLight light;
    light.to_light = glm::normalize(glm::vec3(1, 0.3f, 0.2f));
    light.irradiance = glm::vec3(3);
    scene.directional_lights = {light};
    scene.cameras = {camera_at({0, 0.5f, 5}, {0, 0, 0}, 0.5f)};
    return scene;
}

Scene sphere() {
    Scene scene = lit_from_the_side();
    scene.spheres = {{glm::vec3(0), 1.0f, 0}};
    return scene;
}

/// Of triangles, with normals that point inward where `outward` is -1.
Scene ball(uint32_t rows, glm::mat4 transform = glm::mat4(1), float outward = 1.0f) {
    Scene scene = lit_from_the_side();
    Mesh mesh = faceted_ball(2 * rows, rows);
    for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(outward * p);
    scene.meshes = {mesh};
    scene.instances = {{0, transform}};
    return scene;
}

Image picture(const Scene& scene, IntegratorKind integrator = IntegratorKind::path) {
    RenderOptions options = small_options(SIZE, SIZE, 4);
    options.integrator = integrator;
    options.depth = 2;
    return render_scene(scene, options).image;
}

/// The largest difference of two pictures, and the mean, over what is well inside the ball's
/// outline.
struct Difference {
    float most = 0.0f, mean = 0.0f;
};

Difference difference(const Image& a, const Image& b) {
    constexpr float INSIDE = 0.33f * SIZE;
    Difference d;
    uint32_t count = 0;
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            const glm::vec2 from = glm::vec2(x, y) - glm::vec2(0.5f * (SIZE - 1));
            if (glm::length(from) > INSIDE) continue;
            const size_t i = 3 * (size_t(y) * SIZE + x);
            const float apart = std::abs(a.pixels[i] - b.pixels[i]);
            d.most = std::max(d.most, apart);
            d.mean += apart;
            count++;
        }
    d.mean /= float(count);
    return d;
}

/// Differences fall with the square of the triangles' size, as those of the normals do.
void check_like_sphere(const Scene& scene, uint32_t rows,
                       IntegratorKind integrator = IntegratorKind::path) {
    const Difference d = difference(picture(scene, integrator), picture(sphere(), integrator));
    INFO(rows << " rows: at most " << d.most << ", on average " << d.mean);
    CHECK(d.most < 2.0f / float(rows * rows));
    CHECK(d.mean < 0.35f / float(rows * rows));
}

} // namespace

TEST_CASE("light fades out on a ball of few triangles as on a sphere") {
    for (const uint32_t rows : {4u, 6u, 12u, 24u}) check_like_sphere(ball(rows), rows);
}

TEST_CASE("ray trees light balls of few triangles like spheres too") {
    check_like_sphere(ball(6), 6, IntegratorKind::whitted);
}

TEST_CASE("curved triangles may be turned around, mirrored, scaled and placed many times") {
    check_like_sphere(ball(6, glm::mat4(1), -1.0f), 6);
    check_like_sphere(ball(6, glm::scale(glm::mat4(1), {-1, 1, 1})), 6);
    Scene copies = ball(24, glm::scale(glm::mat4(1), glm::vec3(4)));
    for (glm::vec3& p : copies.meshes[0].positions) p *= 0.25f;
    copies.instances.push_back({0, glm::translate(glm::mat4(1), {0, 0, -90})});
    check_like_sphere(copies, 24);
}

TEST_CASE("what stands before the light keeps it from curved triangles") {
    Scene scene = ball(6);
    Mesh wall;
    wall.positions = {{3, -9, -9}, {3, 9, -9}, {3, 0, 9}};
    wall.triangles = {{0, 1, 2}};
    wall.materials = {0};
    scene.meshes.push_back(wall);
    scene.instances.push_back({1, glm::mat4(1)});
    for (const float value : picture(scene).pixels) REQUIRE(value == 0.0f);
}

} // namespace onde::test
