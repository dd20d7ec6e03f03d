// Geometry as a glTF file poses it: morph targets, skins, animations, instances, scenes, variants.
#include "gltf_builder.h"
#include "support/assets.h"
#include "support/folders.h"

#include <cmath>

using namespace onde;
using onde::test::Builder;
using onde::test::bytes_of;
using onde::test::has_note;
using onde::test::ScratchFolder;
using onde::test::triangle;

namespace {

const std::string MESH = R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])";

glm::vec3 placed(const Scene& scene, size_t vertex, size_t instance = 0) {
    const Instance& i = scene.instances.at(instance);
    return glm::vec3(i.object_to_world *
                     glm::vec4(scene.meshes.at(i.mesh).positions.at(vertex), 1.0f));
}

bool close(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 1e-5f;
}

} // namespace

TEST_CASE("morph targets move vertices by the mesh's weights, and the node's come before them") {
    Builder builder = triangle();
    builder.floats(3, {0, 0, 2, 0, 0, 0, 0, 0, 0});
    builder.floats(3, {0, 4, 0, 0, 0, 0, 0, 0, 0});
    const std::string mesh = R"("meshes": [{"weights": [0.5, 0.25], "primitives": [{"attributes":
        {"POSITION": 0}, "targets": [{"POSITION": 1}, {"POSITION": 2}]}]}])";
    const Scene scene = builder.load(
        mesh + R"(, "nodes": [{"mesh": 0}, {"mesh": 0, "weights": [1, 0]}, {"mesh": 0}])");
    CHECK(close(placed(scene, 0, 0), {0, 1, 1}));
    CHECK(close(placed(scene, 0, 1), {0, 0, 2}));
    CHECK(close(placed(scene, 1, 1), {1, 0, 0}));
    CHECK(scene.meshes.size() == 2); // equal weights share a mesh
    CHECK_THROWS_WITH(builder.load(R"("meshes": [{"weights": [1], "primitives": [{"attributes":
        {"POSITION": 0}, "targets": [{"POSITION": 9}]}]}], "nodes": [{"mesh": 0}])"),
                      Catch::Contains("accessor 9, but there are 3"));
}

TEST_CASE("morph targets may be sparse and move normals") {
    ScratchFolder folder;
    folder.write("m.bin", bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1}) +
                              bytes_of<float>({3, 4, 5, 0, 1, -1, 0, 1, -1, 0, 1, -1}) +
                              bytes_of<uint16_t>({2, 0}));
    const Scene scene = load_scene(folder.write("m.gltf", R"({"asset": {"version": "2.0"},
  "nodes": [{"mesh": 0}], "meshes": [{"weights": [1], "primitives": [{"attributes":
    {"POSITION": 0, "NORMAL": 1}, "targets": [{"POSITION": 2, "NORMAL": 3}]}]}],
  "buffers": [{"uri": "m.bin", "byteLength": 124}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36},
    {"buffer": 0, "byteOffset": 72, "byteLength": 12},
    {"buffer": 0, "byteOffset": 84, "byteLength": 36}, {"buffer": 0, "byteOffset": 120, "byteLength": 4}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
    {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": 3},
    {"componentType": 5126, "type": "VEC3", "count": 3, "sparse": {"count": 1,
      "indices": {"bufferView": 4, "componentType": 5123}, "values": {"bufferView": 2}}},
    {"bufferView": 3, "componentType": 5126, "type": "VEC3", "count": 3}]})"));
    CHECK(close(placed(scene, 2), {3, 5, 5}));
    CHECK(close(placed(scene, 1), {1, 0, 0}));
    CHECK(close(scene.meshes.at(0).normals.at(0), {0, 1, 0}));
}

TEST_CASE("a skin places vertices by its joints; the mesh's node does not count") {
    Builder builder = triangle();
    builder.add<uint8_t>(5121, "VEC4", 4, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
    builder.floats(4, {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0});
    builder.floats(16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0.999999f});
    const std::string body = R"("meshes": [{"primitives": [{"attributes":
        {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
      "skins": [{"joints": [1, 2], "inverseBindMatrices": 3}],
      "nodes": [{"mesh": 0, "skin": 0, "scale": [100, 100, 100], "translation": [5, 5, 5]},
                {"translation": [0, 0, 7], "children": [2]}, {"translation": [1, 10, 0]}])";
    const Scene scene = builder.load(body);
    CHECK(close(placed(scene, 0), {0, 0, 7}));
    CHECK(close(placed(scene, 1), {1, 10, 7}));       // (1 0 0) is joint 1's own place
    CHECK(close(placed(scene, 2), {0, 1 + 5.0f, 7})); // half way
    std::string wrong = body;
    wrong.replace(wrong.find("[1, 2]"), 6, "[1]");
    CHECK_THROWS_WITH(builder.load(wrong), Catch::Contains("names joint 1, but there are 1"));
    wrong.replace(wrong.find("[1]"), 3, "[1, 2, 3]");
    CHECK_THROWS_WITH(builder.load(wrong), Catch::Contains("matrices for 3 joints"));
}

TEST_CASE("animations move nodes at the moment that is asked for") {
    Builder builder = triangle();
    builder.floats(1, {1, 3});
    builder.floats(3, {0, 0, 0, 4, 0, 0});
    builder.floats(4, {0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f});
    const auto load = [&](const std::string& interpolation, std::optional<double> at) {
        LoadOptions options;
        options.at = at;
        return builder.load(MESH + R"(, "nodes": [{"mesh": 0}], "animations": [{"samplers": [
              {"input": 1, "output": 2, "interpolation": ")" +
                                interpolation + R"("}, {"input": 1, "output": 3}],
              "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
                           {"sampler": 1, "target": {"node": 0, "path": "rotation"}}]}])",
                            options);
    };
    CHECK(close(placed(load("LINEAR", {}), 1), {1, 0, 0}));
    CHECK(has_note(load("LINEAR", {}), "--at"));
    CHECK(close(placed(load("LINEAR", 0.0), 1), {1, 0, 0})); // before its begin
    const float turn = float(M_PI) / 8;
    CHECK(close(placed(load("LINEAR", 1.5), 1), {1 + std::cos(turn), std::sin(turn), 0}));
    CHECK(close(placed(load("STEP", 1.5), 1), {std::cos(turn), std::sin(turn), 0}));
    CHECK(close(placed(load("LINEAR", 99.0), 1), {4, 1, 0}));
    CHECK_THROWS_WITH(load("SMOOTH", 1.0), Catch::Contains("interpolation"));
    CHECK_THROWS_WITH(load("CUBICSPLINE", 1.0), Catch::Contains("6 numbers for 2 keys of 9"));
}

TEST_CASE("cubic splines follow their tangents, and weights are animated") {
    Builder builder = triangle();
    builder.floats(1, {0, 2});
    builder.floats(3, {0, 0, 0, 0, 0, 0, 1, 0, 0, -3, 0, 0, 8, 0, 0, 0, 0, 0});
    builder.floats(3, {0, 0, 2, 0, 0, 0, 0, 0, 0});
    builder.floats(1, {0, 1});
    LoadOptions options;
    options.at = 1.0;
    const Scene scene = builder.load(
        R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 3}]}]}],
           "nodes": [{"mesh": 0}], "animations": [{"samplers": [
             {"input": 1, "output": 2, "interpolation": "CUBICSPLINE"}, {"input": 1, "output": 4}],
             "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},
                          {"sampler": 1, "target": {"node": 0, "path": "weights"}}]}])",
        options);
    // Half way: 0 / 2 + 8 / 2 + 2 s (1 / 8) - 2 s (-3 / 8 / 3 ...): the Hermite basis at 1/2.
    CHECK(close(placed(scene, 0), {4 + 2 * 0.125f * 1 - 2 * 0.125f * -3, 0, 1}));
}

TEST_CASE("of animations that move the same the first counts, or the one that is named") {
    Builder builder = triangle();
    builder.floats(1, {0});
    builder.floats(3, {1, 0, 0});
    builder.floats(3, {2, 0, 0});
    builder.floats(3, {7, 7, 7});
    const auto load = [&](const std::string& animation, std::optional<double> at = 0.0) {
        LoadOptions options;
        options.at = at;
        options.animation = animation;
        const auto channel = [](const char* name, int output, const char* path) {
            return fmt::format(R"({{"name": "{}", "samplers": [{{"input": 1, "output": {}}}],
              "channels": [{{"sampler": 0, "target": {{"node": 0, "path": "{}"}}}}]}})",
                               name, output, path);
        };
        return builder.load(MESH + R"(, "nodes": [{"mesh": 0}], "animations": [)" +
                                channel("walk", 2, "translation") + ", " +
                                channel("run", 3, "translation") + ", " +
                                channel("grow", 4, "scale") + "]",
                            options);
    };
    CHECK(close(placed(load(""), 1), {1 + 7, 0, 0}));
    CHECK(has_note(load(""), "--animation"));
    CHECK(close(placed(load("run"), 1), {2 + 1, 0, 0}));
    CHECK(close(placed(load("2"), 1), {7, 0, 0}));
    for (const auto at : {std::optional(0.0), std::optional<double>()})
        CHECK_THROWS_WITH(load("fly", at), Catch::Contains("0 'walk', 1 'run', 2 'grow'"));
}

TEST_CASE("a file without the animation that is named says what it has") {
    Builder builder = triangle();
    builder.floats(1, {0});
    builder.floats(3, {1, 0, 0});
    LoadOptions options;
    options.animation = "x";
    const std::string nodes = MESH + R"(, "nodes": [{"mesh": 0}])";
    CHECK_THROWS_WITH(builder.load(nodes, options),
                      Catch::Contains("it has no animations, so none is 'x'"));
    CHECK_THROWS_WITH(builder.load(nodes + R"(, "animations": [{"samplers": [{"input": 1,
                        "output": 2}], "channels": [{"sampler": 0, "target":
                        {"node": 0, "path": "translation"}}]}])",
                                   options),
                      Catch::Contains("those that it has, by number: 0 without a name"));
}

TEST_CASE("instances of EXT_mesh_gpu_instancing are placed within their node") {
    Builder builder = triangle();
    builder.floats(3, {1, 0, 0, 0, 2, 0});
    builder.add<int16_t>(5122, "VEC4", 4, {0, 0, 0, 32767, 0, 0, 32767, 0}, true);
    builder.floats(3, {1, 1, 1});
    const auto nodes = [](const std::string& attributes) {
        return MESH + R"(, "nodes": [{"mesh": 0, "translation": [10, 0, 0], "extensions":
            {"EXT_mesh_gpu_instancing": {"attributes": {)" +
               attributes + "}}}}]";
    };
    const Scene scene = builder.load(nodes(R"("TRANSLATION": 1, "ROTATION": 2)"));
    REQUIRE(scene.instances.size() == 2);
    CHECK(scene.meshes.size() == 1);
    CHECK(close(placed(scene, 1, 0), {12, 0, 0}));
    CHECK(close(placed(scene, 1, 1), {9, 2, 0}));
    CHECK_THROWS_WITH(builder.load(nodes(R"("TRANSLATION": 1, "SCALE": 3)")),
                      Catch::Contains("SCALE: it has 1 elements where another has 2"));
}

TEST_CASE("scenes and material variants are chosen by name or number") {
    Builder builder = triangle();
    const std::string body = R"("scene": 1, "scenes": [{"name": "one", "nodes": [0]},
        {"name": "two", "nodes": [1]}], "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}],
      "materials": [{"name": "a"}, {"name": "b"}], "extensions": {"KHR_materials_variants":
        {"variants": [{"name": "red"}, {"name": "blue"}]}},
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0, "extensions":
        {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}}}]}])";
    const auto load = [&](const std::string& scene, const std::string& variant) {
        LoadOptions options;
        options.scene = scene;
        options.variant = variant;
        return builder.load(body, options);
    };
    CHECK(placed(load("", ""), 0).x == 5);
    CHECK(has_note(load("", ""), "--scene"));
    CHECK(has_note(load("", ""), "0 'red', 1 'blue'"));
    CHECK(placed(load("one", ""), 0).x == 0);
    CHECK(placed(load("0", ""), 0).x == 0);
    CHECK(load("", "").meshes.at(0).materials.at(0) == 0);
    CHECK(load("", "red").meshes.at(0).materials.at(0) == 0);
    CHECK(load("", "blue").meshes.at(0).materials.at(0) == 1);
    CHECK_THROWS_WITH(load("three", ""), Catch::Contains("no scene 'three'"));
    CHECK_THROWS_WITH(load("", "2"), Catch::Contains("no material variant '2'"));
}

TEST_CASE("a node that the file hides is skipped with its children") {
    const Scene scene = triangle().load(
        MESH + R"(, "nodes": [{"mesh": 0}, {"mesh": 0, "children": [2], "extensions":
            {"KHR_node_visibility": {"visible": false}}}, {"mesh": 0}])");
    CHECK(scene.instances.size() == 1);
}

TEST_CASE("meshes that are built from the same data are built once") {
    Builder builder = triangle();
    std::string meshes, nodes;
    for (int i = 0; i < 100; ++i) {
        meshes += fmt::format(R"({}{{"name": "m{}", "primitives": [{{"attributes":
            {{"POSITION": 0}}}}]}})",
                              i ? ", " : "", i);
        nodes += fmt::format(R"({}{{"mesh": {}}})", i ? ", " : "", i);
    }
    const Scene scene = builder.load("\"meshes\": [" + meshes + "], \"nodes\": [" + nodes + "]");
    CHECK(scene.instances.size() == 100);
    CHECK(scene.meshes.size() == 1);
}

TEST_CASE("numbers that are none cost their triangles, or nothing where no triangle uses them") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Builder builder;
    builder.floats(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0});
    builder.floats(3, {0, 0, nan, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    builder.add<uint16_t>(5123, "SCALAR", 1, {0, 1, 2, 1, 2, 3});
    builder.add<uint16_t>(5123, "SCALAR", 1, {0, 1, 2});
    const auto load = [&](const std::string& primitive, bool strict = false) {
        LoadOptions options;
        options.strict = strict;
        return builder.load(R"("nodes": [{"mesh": 0}], "meshes": [{"primitives": [{)" + primitive +
                                "}]}]",
                            options);
    };
    const std::string used = R"("attributes": {"POSITION": 0}, "indices": 2)";
    CHECK(load(used).meshes.at(0).triangles.size() == 1);
    CHECK(has_note(load(used), "Faces with positions"));
    CHECK_THROWS_WITH(load(used, true), Catch::Contains("mesh 0 primitive 0"));
    const Scene unused = load(R"("attributes": {"POSITION": 0}, "indices": 3)", true);
    CHECK(unused.meshes.at(0).triangles.size() == 1);
    CHECK_FALSE(has_note(unused, "Faces"));
    const Scene normals = load(R"("attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 3)");
    CHECK(normals.meshes.at(0).normals.at(0) == glm::vec3(0, 0, 1));
    CHECK(has_note(normals, "Normals"));
}

TEST_CASE("a test model whose cubes move by their interpolation stands where its text says") {
    const auto path = test::find_asset("gltf/InterpolationTest/glTF-Binary/InterpolationTest.glb");
    const auto fox = test::find_asset("gltf/Fox/glTF-Binary/Fox.glb");
    if (!path || !fox) return;
    LoadOptions options;
    options.at = 0.7;
    const Scene rest = load_scene(*path), moved = load_scene(*path, options);
    size_t differ = 0;
    for (size_t i = 0; i < rest.instances.size(); ++i)
        differ += rest.instances[i].object_to_world != moved.instances[i].object_to_world;
    CHECK(differ == 9);
    options.animation = "Run";
    const SceneBounds standing = scene_bounds(load_scene(*fox)),
                      running = scene_bounds(load_scene(*fox, options));
    CHECK(running.high.z - running.low.z > 1.05f * (standing.high.z - standing.low.z));
}

TEST_CASE("the fuzzer's first glTF files load, whatever they compress or move") {
    size_t loaded = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(onde::test::in_project("tests/data/fuzz"))) {
        if (entry.path().extension() != ".gltf") continue;
        INFO(entry.path().string());
        LoadOptions options;
        options.at = 0.5;
        CHECK_FALSE(load_scene(entry.path(), options).instances.empty());
        ++loaded;
    }
    CHECK(loaded >= 6);
}
