// However the geometry reaches Embree, the surface is the same.
#include "support/reference/compare.h"
#include "support/reference/geometry.h"
#include "support/reference/sampling.h"
#include "support/reference/scenes.h"

#include <catch2/catch.hpp>

#include <glm/gtc/matrix_transform.hpp>

using namespace onde;
using namespace onde::reference;

namespace {

constexpr glm::vec3 DOWN{0.0f, 0.0f, -1.0f};

glm::mat4 skewed() {
    glm::mat4 m = glm::translate(glm::mat4(1.0f), {0.1f, -0.2f, 0.3f});
    m = glm::rotate(m, 0.4f, {0.2f, 1.0f, 0.1f});
    return glm::scale(m, {1.5f, 0.7f, 2.0f});
}

/// A square of sloped normals under `transform`; with `twice`, a second far away makes it an
/// Embree instance.
Scene sloped_square(const glm::mat4& transform, bool twice) {
    Scene scene;
    scene.materials = {diffuse(glm::vec3(0.5f))};
    Mesh mesh = parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0);
    for (const glm::vec2& uv : mesh.uvs)
        mesh.normals.push_back(glm::normalize(glm::vec3(uv - 0.5f, 1.0f)));
    add_mesh(scene, mesh, transform);
    if (twice)
        scene.instances.push_back({0, glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -100.0f})});
    return scene;
}

struct Seen {
    SurfacePoint point;
    glm::vec2 uv;
    Tangents tangents;
};

Seen look(const Geometry& geometry, const Ray& ray) {
    const std::optional<Hit> hit = geometry.intersect(ray);
    REQUIRE(hit);
    return {geometry.surface_point(*hit), geometry.uv(*hit), geometry.tangents(*hit)};
}

void check_near(const glm::vec3& a, const glm::vec3& b) {
    INFO("(" << a.x << ", " << a.y << ", " << a.z << ") against (" << b.x << ", " << b.y << ", "
             << b.z << ")");
    CHECK(glm::length(a - b) < 1e-4f);
}

} // namespace

TEST_CASE("a baked mesh and an instanced one are the same surface, mirrored or not") {
    const glm::mat4 mirror = glm::scale(skewed(), {-1.0f, 1.0f, 1.0f});
    for (const glm::mat4& transform : {skewed(), mirror}) {
        const Geometry baked(sloped_square(transform, false));
        const Geometry instanced(sloped_square(transform, true));
        const Ray ray{{0.3f, 0.1f, 5.0f}, DOWN};
        const Seen a = look(baked, ray), b = look(instanced, ray);
        check_near(a.point.position, b.point.position);
        check_near(a.point.geometric_normal, b.point.geometric_normal);
        check_near(a.point.shading_normal, b.point.shading_normal);
        check_near(glm::vec3(a.uv, 0.0f), glm::vec3(b.uv, 0.0f));
        check_near(a.tangents.dpdu, b.tangents.dpdu);
        check_near(a.tangents.dpdv, b.tangents.dpdv);
        CHECK(a.point.geometric_normal.z > 0.0f); // a mirror turns no surface inside out
        check_near(a.tangents.dpdu, glm::vec3(transform * glm::vec4(2, 0, 0, 0)));
        check_near(a.tangents.dpdv, glm::vec3(transform * glm::vec4(0, 2, 0, 0)));
    }
}

TEST_CASE("a mirrored instance of a light shines from the same side, baked or instanced") {
    for (const bool twice : {false, true}) {
        Scene scene;
        scene.materials = {emitter(glm::vec3(1.0f))};
        scene.cameras = {look_at({0, 0, 3}, {0, 0, 0}, 0.1f)};
        add_mesh(scene, parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0),
                 glm::scale(glm::mat4(1.0f), {-1.0f, 1.0f, 1.0f}));
        if (twice)
            scene.instances.push_back({0, glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -9.0f})});
        const ReferenceResult result = ReferenceRenderer(scene).render({.samples = 1, .depth = 1});
        for (const glm::vec3& pixel : result.mean) REQUIRE(pixel.x == 1.0f);
    }
}

TEST_CASE("sphere hits lie on the sphere, from outside and from inside") {
    Scene scene = furnace(diffuse(glm::vec3(0.5f)));
    scene.spheres[0] = {{100.0f, 50.0f, -20.0f}, 0.5f, 0};
    const Geometry geometry(scene);
    const glm::vec3 center = scene.spheres[0].center;
    const Seen outside = look(geometry, {center + glm::vec3(0.2f, 0.1f, 60.0f), DOWN});
    CHECK(glm::length(outside.point.position - center) == Approx(0.5f).epsilon(1e-4));
    CHECK(outside.point.geometric_normal.z > 0.0f);
    const Seen inside = look(geometry, {center, DOWN});
    check_near(inside.point.geometric_normal, DOWN);
}

TEST_CASE("rays that leave a surface do not meet it again") {
    Scene scene = furnace(diffuse(glm::vec3(0.5f)));
    scene.spheres[0] = {{30.0f, 10.0f, -1000.0f}, 20.0f, 0};
    add_mesh(scene, parallelogram({-900, -900, 7}, {1800, 3, 0}, {0, 1800, 4}, 0), skewed());
    const Geometry geometry(scene);
    Random random(1, 2, 3);
    uint32_t again = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        const glm::vec3 target(30.0f * random.next(), 10.0f, -1000.0f * random.next());
        const std::optional<Hit> hit =
            geometry.intersect({{0, 0, 300}, glm::normalize(target - glm::vec3(0, 0, 300))});
        if (!hit) continue;
        const SurfacePoint point = geometry.surface_point(*hit);
        const glm::vec3 d =
            Frame(point.geometric_normal).to_world(sample_cosine_hemisphere(random.next2()));
        const std::optional<Hit> next = geometry.intersect({leave_surface(point, d), d});
        again += next && next->shape == hit->shape && next->primitive == hit->primitive;
    }
    CHECK(again == 0);
}
