// What lies at a hit: position, sides, shading normals, normal maps.
#include "kernels/scene_probe.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

namespace {

struct Found {
    glm::dvec3 position, geometric, normal;
    bool front = false;
    uint32_t light = NO_INDEX;
    double bulge = 0;
};

/// What a ray finds; it must find something.
Found look(SceneProbe& probe, glm::vec3 origin, glm::vec3 direction) {
    Columns in;
    add_vectors(in, {origin});
    add_vectors(in, {direction});
    in.push_back({1});
    const Columns out = probe.run("surface", in, 18);
    REQUIRE(out[0][0] == 1);
    return {vector_at(out, 2, 0), vector_at(out, 5, 0),  vector_at(out, 8, 0),
            out[11][0] != 0,      from_word(out[12][0]), out[17][0]};
}

void check_near(glm::dvec3 got, glm::dvec3 wanted, double bound) {
    INFO("(" << got.x << ", " << got.y << ", " << got.z << ") instead of (" << wanted.x << ", "
             << wanted.y << ", " << wanted.z << ")");
    CHECK(glm::length(got - wanted) < bound);
}

/// A triangle in the plane z = 0 with its front toward +Z; u grows along +X (or -X) and v along -Y,
/// as pictures lie.
Scene wall(bool mirrored = false) {
    Scene scene;
    add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {});
    const float left = mirrored ? 1.0f : 0.0f;
    scene.meshes[0].uvs = {{left, 1}, {1 - left, 1}, {left, 0}};
    return scene;
}

Scene mapped_wall(bool mirrored, uint8_t x, uint8_t y, float scale = 1) {
    Scene scene = wall(mirrored);
    Texture map;
    map.image = {1, 1, {x, y, 255, 255}};
    map.srgb = false;
    scene.textures.push_back(map);
    scene.materials[0].normal_texture = 0;
    scene.materials[0].normal_scale = scale;
    return scene;
}

const glm::vec3 BEFORE(0.25f, 0.25f, 2), BEHIND(0.25f, 0.25f, -2);

} // namespace

TEST_CASE("a triangle shows its front on the side from which its corners turn left") {
    SceneProbe probe(wall(), {"surface"});
    const Found before = look(probe, BEFORE, {0, 0, -1}), behind = look(probe, BEHIND, {0, 0, 1});
    check_near(before.position, {0.25, 0.25, 0}, 1e-6);
    check_near(before.geometric, {0, 0, 1}, 1e-6);
    check_near(before.normal, {0, 0, 1}, 1e-4);
    CHECK(before.front);
    check_near(behind.geometric, {0, 0, -1}, 1e-6);
    check_near(behind.normal, {0, 0, -1}, 1e-4);
    CHECK_FALSE(behind.front);
    CHECK(before.light == NO_INDEX);
}

TEST_CASE("corner normals are interpolated, and turned to the side that is seen") {
    Scene scene = wall();
    const glm::vec3 normals[] = {glm::normalize(glm::vec3(-1, -1, 3)),
                                 glm::normalize(glm::vec3(2, 0, 3)),
                                 glm::normalize(glm::vec3(0, 2, 3))};
    scene.meshes[0].normals = {normals[0], normals[1], normals[2]};
    SceneProbe probe(scene, {"surface"});
    const glm::dvec3 wanted =
        glm::normalize(glm::dvec3(normals[0]) * 0.5 + glm::dvec3(normals[1]) * 0.25 +
                       glm::dvec3(normals[2]) * 0.25);
    check_near(look(probe, BEFORE, {0, 0, -1}).normal, wanted, 1e-4);
    check_near(look(probe, BEHIND, {0, 0, 1}).normal, -wanted, 1e-4);
}

TEST_CASE("a triangle with other normals at its corners bulges on the side where it is convex") {
    Scene scene = wall();
    const glm::dvec3 p[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const glm::dvec3 n[] = {glm::normalize(glm::dvec3(-1, -1, 3)),
                            glm::normalize(glm::dvec3(2, 0.5, 3)),
                            glm::normalize(glm::dvec3(-1, -1.2, 3))}; // concave along the last edge
    for (const glm::dvec3& normal : n) scene.meshes[0].normals.emplace_back(normal);
    SceneProbe probe(scene, {"surface"});
    const auto edge = [&](int i, int j) { return glm::dot(p[i] - p[j], n[i] - n[j]); };
    REQUIRE(edge(1, 2) > 0);
    REQUIRE(edge(2, 0) < 0);
    // The weights are 1/2, 1/4 and 1/4.
    const double front = edge(0, 1) / 8 + edge(1, 2) / 16, back = -edge(2, 0) / 8;
    const double seen_front = look(probe, BEFORE, {0, 0, -1}).bulge;
    const double seen_back = look(probe, BEHIND, {0, 0, 1}).bulge;
    INFO(seen_front << " for " << front << ", " << seen_back << " for " << back);
    const double unit = edge(0, 1) / 63; // at most; rounded away from 0
    CHECK((seen_front >= front && seen_front < front + unit * 3 / 16));
    CHECK((seen_back >= back && seen_back < back + unit / 8));
    SceneProbe flat(wall(), {"surface"});
    CHECK(look(flat, BEFORE, {0, 0, -1}).bulge == 0);
}

TEST_CASE("a shading normal that is seen from behind gives way to the geometric one") {
    Scene scene = wall();
    scene.meshes[0].normals.assign(3, glm::normalize(glm::vec3(1, 0, 0.2f)));
    SceneProbe probe(scene, {"surface"});
    const glm::vec3 direction = glm::normalize(glm::vec3(1, 0, -0.1f));
    const Found found = look(probe, glm::vec3(0.25f, 0.25f, 0) - direction, direction);
    check_near(found.normal, {0, 0, 1}, 1e-6);
}

TEST_CASE("a sphere's normals point away from its centre outside, and to it inside") {
    Scene scene;
    scene.materials.emplace_back();
    scene.spheres.push_back({{1, 2, 3}, 2, 0});
    SceneProbe probe(scene, {"surface"});
    Generator generator(91);
    for (int i = 0; i < 64; i++) {
        const glm::vec3 outward = unit_vector(generator);
        const glm::vec3 centre(1, 2, 3);
        const Found outside = look(probe, centre + 5.0f * outward, -outward);
        check_near(outside.position, glm::dvec3(centre + 2.0f * outward), 2e-6);
        check_near(outside.geometric, glm::dvec3(outward), 1e-6);
        CHECK(outside.front);
        const Found inside = look(probe, centre, outward);
        check_near(inside.position, glm::dvec3(centre + 2.0f * outward), 2e-6);
        check_near(inside.normal, -glm::dvec3(outward), 1e-6);
        CHECK_FALSE(inside.front);
    }
}

TEST_CASE("normal maps bend the normal along u with red and up the picture with green") {
    // 255 is one, and 128 is as near to zero as bytes come.
    const double little = 128 / 127.5 - 1;
    for (bool mirrored : {false, true}) {
        INFO((mirrored ? "mirrored" : "not mirrored"));
        const double right = mirrored ? -1 : 1;
        SceneProbe red(mapped_wall(mirrored, 255, 128), {"surface"});
        check_near(look(red, BEFORE, {0, 0, -1}).normal,
                   glm::normalize(glm::dvec3(right, little, 1)), 1e-3);
        SceneProbe green(mapped_wall(mirrored, 128, 255), {"surface"});
        check_near(look(green, BEFORE, {0, 0, -1}).normal,
                   glm::normalize(glm::dvec3(right * little, 1, 1)), 1e-3);
        SceneProbe scaled(mapped_wall(mirrored, 0, 128, 0.5f), {"surface"});
        check_near(look(scaled, BEFORE, {0, 0, -1}).normal,
                   glm::normalize(glm::dvec3(-right * 0.5, 0.5 * little, 1)), 1e-3);
    }
}

TEST_CASE("a surface knows the light that it is") {
    Scene scene = wall();
    Material lamp;
    lamp.emission = glm::vec3(1);
    add_triangle(scene, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}, lamp);
    add_triangle(scene, {0, 0, 6}, {1, 0, 6}, {0, 1, 6}, lamp);
    SceneProbe probe(scene, {"surface"});
    CHECK(look(probe, BEFORE, {0, 0, -1}).light == NO_INDEX);
    CHECK(look(probe, BEFORE, {0, 0, 1}).light == 0);
    CHECK(look(probe, {0.25f, 0.25f, 9}, {0, 0, -1}).light == 1);
}
