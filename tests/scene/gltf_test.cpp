// Meshes, nodes, cameras and lights of glTF.
#include "gltf_builder.h"
#include "gltf_quad.h"

using namespace onde;
using namespace onde::test;

namespace {

/// A mesh of the given floats as non-indexed positions in that primitive mode.
Scene load_positions(std::initializer_list<float> positions, int mode) {
    ScratchFolder folder;
    folder.write("p.bin", bytes_of<float>(positions));
    const std::string bytes = std::to_string(positions.size() * 4);
    return load_scene(
        folder.write("p.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": )" +
                                   std::to_string(mode) + R"(}]}],
  "buffers": [{"uri": "p.bin", "byteLength": )" +
                                   bytes + R"(}],
  "bufferViews": [{"buffer": 0, "byteLength": )" +
                                   bytes + R"(}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": )" +
                                   std::to_string(positions.size() / 3) + "}]}"));
}

/// A triangle with an attribute of four elements a vertex, of that component type.
Mesh with_attribute(const std::string& name, const std::string& bytes, int type,
                    const std::string& elements, const std::string& normalized) {
    ScratchFolder folder;
    folder.write("a.bin",
                 bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1}) + bytes);
    return load_scene(folder.write("a.gltf", R"({"asset": {"version": "2.0"},
  "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, ")" +
                                                 name + R"(": 2}}]}],
  "buffers": [{"uri": "a.bin", "byteLength": )" + std::to_string(72 + bytes.size()) +
                                                 R"(}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36},
                  {"buffer": 0, "byteOffset": 72, "byteLength": )" +
                                                 std::to_string(bytes.size()) +
                                                 R"(}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
                {"bufferView": 2, "componentType": )" +
                                                 std::to_string(type) +
                                                 R"(, "count": 3, "type": ")" + elements + "\"" +
                                                 normalized + "}]}"))
        .meshes[0];
}

} // namespace

TEST_CASE("an indexed glTF quad becomes two triangles with its positions and uvs") {
    const Scene scene = load_quad(quad_gltf());
    REQUIRE(scene.meshes.size() == 1);
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.triangles == std::vector{glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)});
    CHECK(mesh.positions[2] == glm::vec3(1, 1, 0));
    CHECK(mesh.uvs[3] == glm::vec2(0, 0));
    CHECK(mesh.normals.empty());
    CHECK(scene.materials[mesh.materials[0]].kind == MaterialKind::metallic_roughness);
}

TEST_CASE("children inherit their parents' translation, rotation and scale") {
    const Scene scene = load_quad(quad_gltf(
        R"([{"children": [1], "translation": [10, 0, 0]},
            {"mesh": 0, "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 3, 4]}])"));
    REQUIRE(scene.instances.size() == 1);
    // Scale first: (1, 1, 1) -> (2, 3, 4); a quarter turn about Z: (-3, 2, 4); then moved.
    const glm::vec3 moved(scene.instances[0].object_to_world * glm::vec4(1, 1, 1, 1));
    CHECK(glm::length(moved - glm::vec3(7, 2, 4)) < 1e-5f);
}

TEST_CASE("two nodes with one mesh are two instances of it") {
    const Scene scene = load_quad(
        quad_gltf(R"([{"mesh": 0}, {"mesh": 0, "scale": [-1, 1, 1]}])", "", "", "[0, 1]"));
    CHECK(scene.meshes.size() == 1);
    REQUIRE(scene.instances.size() == 2);
    CHECK(glm::determinant(scene.instances[1].object_to_world) == Approx(-1.0));
}

TEST_CASE("triangle strips turn every second triangle and fans share their first vertex") {
    const auto points = {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f};
    const Scene strip = load_positions(points, 5), fan = load_positions(points, 6);
    CHECK(strip.meshes[0].triangles == std::vector{glm::uvec3(0, 1, 2), glm::uvec3(1, 3, 2)});
    CHECK(fan.meshes[0].triangles == std::vector{glm::uvec3(1, 2, 0), glm::uvec3(2, 3, 0)});
}

TEST_CASE("normalised integer texture coordinates become fractions") {
    ScratchFolder folder;
    folder.write("m.bin", bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                              bytes_of<uint8_t>({0, 255, 0, 0, 51, 0, 0, 0, 255, 255, 0, 0}));
    const Scene scene = load_scene(folder.write("m.gltf", R"({"asset": {"version": "2.0"},
  "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}}]}],
  "buffers": [{"uri": "m.bin", "byteLength": 48}],
  "bufferViews": [{"buffer": 0, "byteLength": 36},
                  {"buffer": 0, "byteOffset": 36, "byteLength": 12, "byteStride": 4}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5121, "count": 3, "type": "VEC2",
                 "normalized": true}]})"));
    CHECK(scene.meshes[0].uvs[0] == glm::vec2(0, 1));
    CHECK(scene.meshes[0].uvs[1].x == Approx(0.2f));
    CHECK(scene.meshes[0].uvs[2] == glm::vec2(1, 1));
}

TEST_CASE("a sparse accessor replaces the elements that it names") {
    std::string gltf = quad_gltf();
    const std::string view =
        R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3")";
    // Index 2 (the third 16-bit index of the file) gets the second position (1, 0, 0).
    gltf.replace(gltf.find(view), view.size(), view + R"(, "sparse": {"count": 1,
        "indices": {"bufferView": 1, "byteOffset": 4, "componentType": 5123},
        "values": {"bufferView": 0, "byteOffset": 12}})");
    const Scene scene = load_quad(gltf);
    CHECK(scene.meshes[0].positions[2] == glm::vec3(1, 0, 0));
    CHECK(scene.meshes[0].positions[3] == glm::vec3(0, 1, 0));
}

TEST_CASE("unknown optional extensions are reported in notes") {
    const Scene scene =
        load_quad(quad_gltf(R"([{"mesh": 0}])", "", R"(, "extensionsUsed": ["EXT_shiny"])"));
    CHECK(has_note(scene, "EXT_shiny"));
}

TEST_CASE("vertex colours of glTF have three or four numbers, of any normalised type") {
    const auto mesh =
        with_attribute("COLOR_0", bytes_of<uint8_t>({0, 51, 255, 51, 0, 0, 0, 0, 0, 0, 0, 0}), 5121,
                       "VEC4", R"(, "normalized": true)");
    REQUIRE(mesh.colors.size() == 3);
    CHECK(mesh.colors[0] == glm::vec4(0, 0.2f, 1, 0.2f));
    const auto floats = with_attribute(
        "COLOR_0", bytes_of<float>({0.5f, 0.25f, 1, 0, 0, 0, 0, 0, 0}), 5126, "VEC3", "");
    CHECK(floats.colors[0] == glm::vec4(0.5f, 0.25f, 1, 1));
    // An exporter that forgot to say that they are normalised.
    const auto forgot = with_attribute(
        "COLOR_0", bytes_of<uint16_t>({65535, 0, 13107, 65535, 0, 0, 0, 0, 0, 0, 0, 0}), 5123,
        "VEC4", "");
    CHECK(glm::length(forgot.colors[0] - glm::vec4(1, 0, 0.2f, 1)) < 1e-6f);
}

TEST_CASE("tangents of glTF are read, and those that are none are left to be computed") {
    const float nan = std::nanf("");
    const auto mesh = with_attribute(
        "TANGENT", bytes_of<float>({0, 1, 0, -1, 0, 0, 0, 1, nan, 0, 0, 1}), 5126, "VEC4", "");
    REQUIRE(mesh.tangents.size() == 3);
    CHECK(mesh.tangents[0] == glm::vec4(0, 1, 0, -1));
    CHECK(mesh.tangents[1] == glm::vec4(0));
    CHECK(mesh.tangents[2] == glm::vec4(0));
}

TEST_CASE("a glTF camera keeps its field of view and loses its node's scale") {
    const Scene scene = load_quad(quad_gltf(
        R"([{"mesh": 0}, {"camera": 0, "translation": [1, 2, 3], "scale": [5, 5, 5]}])", "",
        R"(, "cameras": [{"type": "perspective", "name": "front",
                          "perspective": {"yfov": 0.5, "znear": 0.1}}])",
        "[0, 1]"));
    REQUIRE(scene.cameras.size() == 1);
    CHECK(scene.cameras[0].name == "front");
    CHECK(scene.cameras[0].vertical_fov == 0.5f);
    CHECK(scene.cameras[0].camera_to_world[0] == glm::vec4(1, 0, 0, 0));
    CHECK(scene.cameras[0].camera_to_world[3] == glm::vec4(1, 2, 3, 1));
}

TEST_CASE("punctual lights shine from their nodes, directional ones along -Z") {
    const Scene scene = load_quad(quad_gltf(
        R"([{"mesh": 0},
            {"translation": [0, 5, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"extensions": {"KHR_lights_punctual": {"light": 1}}},
            {"translation": [0, 7, 0], "extensions": {"KHR_lights_punctual": {"light": 2}}}])",
        "", R"(, "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual":
            {"lights": [{"type": "point", "color": [1, 0.5, 0], "intensity": 8},
                        {"type": "directional", "intensity": 2},
                        {"type": "spot", "intensity": 3, "spot": {"innerConeAngle": 0.1,
                         "outerConeAngle": 0.5}}]}})",
        "[0, 1, 2, 3]"));
    REQUIRE(scene.spot_lights.size() == 1);
    CHECK(scene.spot_lights[0].position == glm::vec3(0, 7, 0));
    CHECK(scene.spot_lights[0].back == glm::vec3(0, 0, 1));
    CHECK(scene.spot_lights[0].intensity == glm::vec3(3));
    CHECK(scene.spot_lights[0].inner_angle == 0.1f);
    CHECK(scene.spot_lights[0].half_angle == 0.5f);
    REQUIRE(scene.point_lights.size() == 1);
    CHECK(scene.point_lights[0].position == glm::vec3(0, 5, 0));
    CHECK(scene.point_lights[0].intensity == glm::vec3(8, 4, 0));
    REQUIRE(scene.directional_lights.size() == 1);
    CHECK(scene.directional_lights[0].to_light == glm::vec3(0, 0, 1));
    CHECK(scene.directional_lights[0].irradiance == glm::vec3(2));
    CHECK(scene.environment.map); // the studio, since the file has no camera
}

TEST_CASE("triangles without area load with a note") {
    const Scene scene = load_positions({0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 4);
    CHECK(scene.meshes[0].triangles.size() == 2);
    CHECK(has_note(scene, "without area"));
}

TEST_CASE("an object that is scaled to nothing is skipped with a note") {
    const Scene scene =
        load_quad(quad_gltf(R"([{"mesh": 0}, {"mesh": 0, "scale": [0, 0, 0]}])", "", "", "[0, 1]"));
    CHECK(scene.instances.size() == 1);
    CHECK(has_note(scene, "skipped"));
}

TEST_CASE("an object that is scaled to a plane is that plane, whichever way it lies") {
    Builder builder; // of a corner, with a normal of each wall
    builder.floats(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    builder.floats(3, {0, -1, 0, 1, 0, 0, 0, 1, 0, 0, 0.6f, 0.8f});
    builder.add<uint16_t>(5123, "SCALAR", 1, {0, 1, 2, 0, 2, 3, 0, 3, 1});
    const Scene scene = builder.load(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0,
        "NORMAL": 1}, "indices": 2}]}], "nodes": [{"mesh": 0, "scale": [2, 0, 3]},
        {"mesh": 0, "scale": [1, 0, 1], "rotation": [0, 0, 0.70710678, 0.70710678]},
        {"children": [3], "scale": [1, 1, 0]},
        {"mesh": 0, "rotation": [0.38268343, 0, 0, 0.92387953], "translation": [0, 0, 5]},
        {"mesh": 0, "scale": [0, 0, 1]}, {"camera": 0, "scale": [1, 1, 0]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
        "scenes": [{"nodes": [0, 1, 2, 4, 5]}])");
    REQUIRE(scene.cameras.size() == 1);
    CHECK(glm::length(scene.cameras[0].camera_to_world[2] - glm::vec4(0, 0, 1, 0)) < 1e-5f);
    REQUIRE(scene.instances.size() == 3); // a line has no area
    CHECK(has_note(scene, "Objects scaled to nothing are skipped (node 4)"));
    const glm::vec3 planes[] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    const glm::vec3 ends[] = {{2, 0, 3}, {0, 1, 1}, {1, 0.70710678f, 0}}; // of x, and of z or y
    for (size_t i = 0; i < 3; ++i) {
        INFO(i);
        const glm::mat4& m = scene.instances[i].object_to_world;
        const Mesh& mesh = scene.meshes.at(scene.instances[i].mesh);
        glm::vec3 most(0.0f);
        for (const glm::vec3& p : mesh.positions) {
            const glm::vec3 placed = glm::vec3(m * glm::vec4(p, 1.0f)) + glm::vec3(scene.origin);
            CHECK(std::abs(glm::dot(placed, planes[i])) < 1e-3f);
            most = glm::max(most, placed);
        }
        CHECK(glm::length(most - ends[i]) < 1e-3f);
        const glm::mat3 normals = glm::transpose(glm::inverse(glm::mat3(m)));
        const glm::vec3 up = glm::normalize(normals * mesh.normals.at(2)); // it leans on the plane
        CHECK(std::abs(glm::dot(up, planes[i])) > 0.99f);
    }
}

TEST_CASE("an orthographic glTF camera keeps the height of its view") {
    const Scene scene =
        load_quad(quad_gltf(R"([{"mesh": 0}, {"camera": 0}])", "",
                            R"(, "cameras": [{"type": "orthographic", "orthographic":
                     {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 10}}])",
                            "[0, 1]"));
    REQUIRE(scene.cameras.size() == 1);
    CHECK(scene.cameras[0].orthographic_height == 4.0f);
}
