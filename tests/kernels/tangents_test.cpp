// Tangent frames by MikkTSpace's rules.
#include "upload/tangents.h"

#include "kernels/scene_probe.h"

#include <catch2/catch.hpp>

using namespace onde;

namespace {

TangentCorner corner(glm::vec3 p, glm::vec2 uv, glm::vec3 normal = {0, 0, 1}) {
    return {p, normal, uv};
}

void check_tangent(glm::vec4 got, glm::vec3 wanted, float sign) {
    INFO("(" << got.x << ", " << got.y << ", " << got.z << ", " << got.w << ")");
    CHECK(glm::length(glm::vec3(got) - wanted) < 1e-5f);
    CHECK(got.w == sign);
}

} // namespace

TEST_CASE("tangents point along u, and the bitangent up the picture") {
    // v runs downward: the picture lies upright on the wall.
    const std::vector<TangentCorner> wall{corner({0, 0, 0}, {0, 1}), corner({1, 0, 0}, {1, 1}),
                                          corner({0, 1, 0}, {0, 0})};
    for (const glm::vec4& t : corner_tangents(wall)) check_tangent(t, {1, 0, 0}, 1);
    std::vector<TangentCorner> mirrored = wall;
    for (TangentCorner& c : mirrored) c.uv.x = 1 - c.uv.x;
    for (const glm::vec4& t : corner_tangents(mirrored)) check_tangent(t, {-1, 0, 0}, -1);
}

TEST_CASE("corners that share everything get the mean of their triangles, weighted by angles") {
    // u grows along X in the first triangle, and along (1, -1) in the second.
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(-1, 1, 0);
    const std::vector<TangentCorner> fan{corner(a, {0, 1}), corner(b, {1, 1}), corner(c, {0, 0}),
                                         corner(a, {0, 1}), corner(c, {0, 0}), corner(d, {-1, 1})};
    const std::vector<glm::vec4> t = corner_tangents(fan);
    const glm::vec3 first(1, 0, 0), second = glm::normalize(glm::vec3(1, -1, 0));
    const glm::vec3 at_a = glm::normalize(90.0f * first + 45.0f * second);
    const glm::vec3 at_c = glm::normalize(45.0f * first + 90.0f * second);
    check_tangent(t[0], at_a, 1);
    check_tangent(t[3], at_a, 1);
    check_tangent(t[2], at_c, 1);
    check_tangent(t[4], at_c, 1);
    check_tangent(t[1], first, 1);
    check_tangent(t[5], second, 1);
}

TEST_CASE("mirrored halves keep their own tangents at the seam") {
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(-1, 0, 0);
    const std::vector<TangentCorner> halves{corner(a, {0, 1}), corner(b, {1, 1}),
                                            corner(c, {0, 0}), corner(a, {0, 1}),
                                            corner(c, {0, 0}), corner(d, {1, 1})};
    const std::vector<glm::vec4> t = corner_tangents(halves);
    for (int k = 0; k < 3; k++) check_tangent(t[size_t(k)], {1, 0, 0}, 1);
    for (int k = 3; k < 6; k++) check_tangent(t[size_t(k)], {-1, 0, 0}, -1);
}

TEST_CASE("triangles without texture coordinates get some tangent across the normal") {
    const glm::vec3 n = glm::normalize(glm::vec3(1, 2, 3));
    const std::vector<TangentCorner> bare{
        corner({0, 0, 0}, {0, 0}, n), corner({1, 0, 0}, {0, 0}, n), corner({0, 1, 0}, {0, 0}, n)};
    for (const glm::vec4& t : corner_tangents(bare)) {
        CHECK(glm::length(glm::vec3(t)) == Approx(1));
        CHECK(std::abs(glm::dot(glm::vec3(t), n)) < 1e-5f);
    }
}

TEST_CASE("only scenes with normal maps keep tangents, and only used sets are packed") {
    Scene scene = test::scene_with_a_speck();
    scene.meshes[0].uvs.assign(3, glm::vec2(0));
    scene.meshes[0].more_uvs = {{}, {{1, 2}, {3, 4}, {5, 6}}};
    Texture texture;
    texture.image = {1, 1, {128, 128, 255, 255}};
    scene.textures = {texture};
    scene.materials[0].base_color_texture = 0;
    PackedScene packed = pack_scene(scene);
    CHECK(packed.tangents.empty());
    CHECK(packed.uvs.empty());
    CHECK(packed.colors.empty());
    scene.textures[0].uv_set = 2;
    scene.materials[0].normal_texture = 0;
    packed = pack_scene(scene);
    CHECK(packed.uvs.empty()); // the one set in use is in the vertices
    CHECK(packed.features.uv_sets == 1);
    CHECK(packed.vertices[1].uv[1] == 2);
    CHECK(packed.tangents.size() == packed.vertices.size());
    texture.same_image_as = 0;
    texture.image = {};
    scene.textures.push_back(texture); // of set 0
    packed = pack_scene(scene);
    CHECK(packed.features.uv_sets == 2);
    CHECK(packed.uvs.size() == 2 * packed.vertices.size());
    CHECK(packed.uvs[2 * 3 + 1] == 6);
    CHECK(packed.texels.size() == 1);
}
