// Files that a renderer must refuse with a sentence that names the file and the culprit.
#include "scratch.h"

using namespace onde;
using onde::test::bytes_of;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

/// The parts of a valid file of one triangle; each case spoils one of them.
struct Parts {
    std::string asset = R"({"version": "2.0"})";
    std::string nodes = R"([{"mesh": 0}])";
    std::string roots = "[0]";
    std::string primitive = R"("attributes": {"POSITION": 0}, "indices": 1)";
    std::string buffers = R"([{"uri": "t.bin", "byteLength": 42}])";
    std::string views = R"([{"buffer": 0, "byteLength": 36},
                           {"buffer": 0, "byteOffset": 36, "byteLength": 6}])";
    std::string positions =
        R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"})";
    std::string indices =
        R"({"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
    std::string extra;
    std::string bytes =
        bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + bytes_of<uint16_t>({0, 1, 2});

    std::string json() const {
        return "{\"asset\": " + asset + ", \"scenes\": [{\"nodes\": " + roots +
               "}], \"nodes\": " + nodes + ", \"meshes\": [{\"primitives\": [{" + primitive +
               "}]}], \"buffers\": " + buffers + ", \"bufferViews\": " + views +
               ", \"accessors\": [" + positions + ", " + indices + "]" + extra + "}";
    }
};

std::string error_of(const Parts& parts) {
    ScratchFolder folder;
    folder.write("t.bin", parts.bytes);
    const std::string error = load_error(folder.write("evil.gltf", parts.json()));
    if (!error.empty()) CHECK_THAT(error, Catch::Contains("evil.gltf"));
    return error;
}

Parts with(std::string Parts::*part, const std::string& text) {
    Parts parts;
    parts.*part = text;
    return parts;
}

std::string little_endian(uint32_t value) {
    return bytes_of<uint32_t>({value});
}

/// A GLB whose header claims `length` (or its true length if 0) and whose chunks are as given.
std::string glb(std::string json, const std::string& rest, uint32_t length = 0,
                uint32_t json_length = 0) {
    while (json.size() % 4) json += ' ';
    const uint32_t total = uint32_t(20 + json.size() + rest.size());
    return "glTF" + little_endian(2) + little_endian(length ? length : total) +
           little_endian(json_length ? json_length : uint32_t(json.size())) + "JSON" + json + rest;
}

} // namespace

TEST_CASE("the file that every hostile case spoils is itself valid") {
    CHECK(error_of({}).empty());
}

TEST_CASE("hostile glTF numbers are refused with their place") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string nan_bytes =
        bytes_of<float>({0, 0, 0, nan, 0, 0, 0, 1, 0}) + bytes_of<uint16_t>({0, 1, 2});
    const std::string index_bytes =
        bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + bytes_of<uint16_t>({0, 1, 3});
    struct Case {
        Parts parts;
        std::string culprit;
    };
    const Case cases[] = {
        {with(&Parts::bytes, nan_bytes), "empty"}, // its only triangle is left out
        {with(&Parts::bytes, index_bytes), "index 2 is 3, but there are 3 positions"},
        {with(&Parts::positions,
              R"({"bufferView": 0, "componentType": 5126, "count": 4000000000, "type": "VEC3"})"),
         "4000000000 elements overrun buffer view 0"},
        // 12 * (2^64 / 12 + 1) wraps to 8 bytes.
        {with(
             &Parts::positions,
             R"({"bufferView": 0, "componentType": 5126, "count": 1537228672809129302, "type": "VEC3"})"),
         "overrun buffer view 0"},
        {with(&Parts::positions, R"({"bufferView": 0, "componentType": 5126, "count": 3,
              "type": "VEC3", "byteOffset": 18446744073709551612})"),
         "overrun buffer view 0"},
        {with(&Parts::positions, R"({"componentType": 5126, "count": 4000000000, "type": "VEC3"})"),
         "without data"},
        {with(&Parts::positions,
              R"({"bufferView": 7, "componentType": 5126, "count": 3, "type": "VEC3"})"),
         "buffer view 7, but there are 2"},
        {with(&Parts::positions,
              R"({"bufferView": 0, "componentType": 5130, "count": 3, "type": "VEC3"})"),
         "accessors[0].componentType: is 5130"},
        {with(&Parts::positions,
              R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC4"})"),
         "must have 3 components"},
        {with(&Parts::indices,
              R"({"bufferView": 1, "componentType": 5126, "count": 1, "type": "SCALAR"})"),
         "not an unsigned integer"},
        {with(&Parts::views, R"([{"buffer": 0, "byteLength": 4000},
              {"buffer": 0, "byteOffset": 36, "byteLength": 6}])"),
         "buffer view 0 overruns its buffer"},
        {with(&Parts::views,
              R"([{"buffer": 0, "byteOffset": 18446744073709551615, "byteLength": 36},
              {"buffer": 0, "byteOffset": 36, "byteLength": 6}])"),
         "buffer view 0 overruns its buffer"},
        {with(&Parts::views, R"([{"buffer": 9, "byteLength": 36},
              {"buffer": 0, "byteOffset": 36, "byteLength": 6}])"),
         "buffer 9, but there are 1"},
        {with(&Parts::primitive, R"("attributes": {"POSITION": 12}, "indices": 1)"),
         "accessor 12, but there are 2"},
        {with(&Parts::primitive, R"("attributes": {"POSITION": 0}, "indices": 12)"),
         "accessor 12, but there are 2"},
        {with(&Parts::primitive, R"("attributes": {"POSITION": 0}, "indices": 4294967297)"),
         "primitives[0].indices: must be a whole number"},
        {with(&Parts::primitive, R"("attributes": {"POSITION": 0}, "mode": 4294967300)"),
         "mode: must be a whole number 0 to 6, not 4294967300"},
        {with(&Parts::primitive, R"("attributes": {"POSITION": 0}, "material": -1)"),
         "material: must be a whole number 0"},
        {with(&Parts::primitive, R"("attributes": {"POSITION": 0.5})"), "not 0.5"},
        {with(&Parts::primitive, R"("attributes": {"POSITION": "0"})"), "not \"0\""},
        {with(&Parts::positions, R"({"bufferView": 0, "componentType": 5126, "count": 3,
              "type": "VEC3", "sparse": {"count": 4000000000,
              "indices": {"bufferView": 1, "componentType": 5123},
              "values": {"bufferView": 0}}})"),
         "4000000000 elements overrun"},
        {with(&Parts::positions, R"({"bufferView": 0, "componentType": 5126, "type": "VEC3"})"),
         "accessors[0].count: is missing"},
        {with(&Parts::buffers, R"([{"uri": "t.bin", "byteLength": 43}])"),
         "buffer 0: it claims 43 bytes, but has 42"},
        {with(&Parts::buffers, R"([{"byteLength": 42}])"), "holds no data"},
        {with(&Parts::buffers, R"([{"uri": "data:;base64,#", "byteLength": 42}])"), "base64"},
        {with(&Parts::buffers, R"([{"uri": "data:;base64", "byteLength": 42}])"), "no comma"},
        {with(&Parts::primitive, R"("attributes": {"POSITION": 0}, "material": 3)"),
         "material 3, but there are 0"},
    };
    for (const Case& c : cases) {
        INFO(c.culprit);
        CHECK_THAT(error_of(c.parts), Catch::Contains(c.culprit));
    }
}

TEST_CASE("hostile glTF node trees are refused with the node") {
    struct Case {
        Parts parts;
        std::string culprit;
    };
    Parts two_parents =
        with(&Parts::nodes, R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])");
    two_parents.roots = "[0, 1]";
    std::string chain = "[";
    for (int i = 0; i < 6000; ++i) chain += "{\"children\": [" + std::to_string(i + 1) + "]}, ";
    const Case cases[] = {
        {with(&Parts::nodes, R"([{"children": [1]}, {"children": [0], "mesh": 0}])"), "node 0"},
        {with(&Parts::nodes, R"([{"children": [0], "mesh": 0}])"), "node 0"},
        {two_parents, "node 2: it is reached twice"},
        {with(&Parts::nodes, chain + R"({"mesh": 0}])"), "nested more than"},
        {with(&Parts::nodes, R"([{"children": [5], "mesh": 0}])"), "node 5, but there are 1"},
        {with(&Parts::nodes, R"([{"children": [-1], "mesh": 0}])"),
         "nodes[0].children: must be a whole number"},
        {with(&Parts::nodes, R"([{"mesh": 4}])"), "mesh 4, but there are 1"},
        {with(&Parts::nodes, R"([{"mesh": 0, "camera": 4}])"), "camera 4, but there are 0"},
        {with(&Parts::nodes, R"([{"mesh": 0, "rotation": [0, 0, 0, 0]}])"), "rotation"},
        {with(&Parts::nodes,
              R"([{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0]}])"),
         "nodes[0].matrix: must be 16 numbers, not 15"},
        {with(&Parts::nodes, R"([{"mesh": 0, "translation": [1, 2]}])"),
         "must be 3 numbers, not 2"},
        {with(&Parts::nodes, R"([{"mesh": 0, "translation": 1}])"), "must be an array, not 1"},
        {with(&Parts::nodes,
              R"([{"mesh": 0, "scale": [1e30, 1e30, 1e30]}, {"scale": [1e300, 1e300, 1e300]}])"),
         "nodes[1].scale: is too large"},
        {with(&Parts::nodes,
              R"([{"children": [1], "scale": [1e30, 1, 1]}, {"mesh": 0, "scale": [1e30, 1, 1]}])"),
         "transform is not finite"},
        {with(&Parts::nodes,
              R"([{"mesh": 0, "matrix": [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}])"),
         "not affine"},
        {with(&Parts::roots, "[3]"), "node 3"},
        {with(&Parts::roots, "[]"), "empty"},
    };
    for (const Case& c : cases) {
        INFO(c.culprit);
        CHECK_THAT(error_of(c.parts), Catch::Contains(c.culprit));
    }
}

TEST_CASE("a glTF file may not refer to files out of its folder") {
    ScratchFolder outside;
    const std::string secret = outside.write("t.bin", Parts().bytes).string();
    for (const std::string uri : {"../t.bin", "%2e%2e/t.bin", "a/../../t.bin", "%2e%2e%2ft.bin"}) {
        INFO(uri);
        CHECK_THAT(
            error_of(with(&Parts::buffers, "[{\"uri\": \"" + uri + "\", \"byteLength\": 42}]")),
            Catch::Contains("leaves the scene's folder"));
    }
    CHECK_THAT(
        error_of(with(&Parts::buffers, "[{\"uri\": \"" + secret + "\", \"byteLength\": 42}]")),
        Catch::Contains("absolute"));
}

TEST_CASE("a symbolic link doesn't lead out of the scene's folder") {
    ScratchFolder folder, outside;
    std::filesystem::create_symlink(outside.write("t.bin", Parts().bytes), folder.path() / "t.bin");
    CHECK_THAT(load_error(folder.write("evil.gltf", Parts().json())),
               Catch::Contains("leaves the scene's folder"));
}

TEST_CASE("missing buffers and textures are named") {
    CHECK_THAT(error_of(with(&Parts::buffers, R"([{"uri": "gone.bin", "byteLength": 42}])")),
               Catch::Contains("gone.bin"));
    Parts parts = with(&Parts::extra, R"(, "materials": [{"pbrMetallicRoughness":
        {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
        "images": [{"uri": "gone.png"}])");
    parts.primitive += R"(, "material": 0)";
    ScratchFolder folder;
    folder.write("t.bin", parts.bytes);
    const auto path = folder.write("evil.gltf", parts.json());
    for (const char* problem : {"missing or can't", "missing or can't"}) {
        const Scene scene = load_scene(path);
        CHECK_THAT(scene.notes.at(0), Catch::Contains("gone.png") && Catch::Contains(problem));
        CHECK(scene.materials.at(0).base_color_texture == NO_TEXTURE);
        CHECK_THROWS_WITH(load_scene(path, {.strict = true}), Catch::Contains("gone.png"));
        folder.write("gone.png", "no picture at all");
    }
}

TEST_CASE("what a glTF file requires and Onde lacks is named") {
    CHECK_THAT(error_of(with(&Parts::extra, R"(, "extensionsRequired": ["EXT_lacking"])")),
               Catch::Contains("EXT_lacking"));
    CHECK_THAT(error_of(with(&Parts::asset, R"({"version": "1.0"})")), Catch::Contains("'1.0'"));
}

TEST_CASE("JSON nested a million deep is refused") {
    const std::string deep(1000000, '[');
    CHECK_THAT(error_of(with(&Parts::extra, ", \"extras\": " + deep)), Catch::Contains("nested"));
}

TEST_CASE("JSON that is no JSON is refused with its line") {
    struct Case {
        std::string extra, culprit;
    };
    const Case cases[] = {
        {",\n\"extras\": }", "not valid JSON at line 3, column 11"},
        {", \"extras\": 1e999", "the number 1e999 of its JSON is too large at line"},
        {", \"extras\": \"\xff\"", "not valid JSON"},
        {", \"extras\": 1} {\"a\": 1", "not valid JSON"},
        {", \"extras\": {\"a\": 1, \"a\": 2}", "'a' stands twice"},
        {", \"accessors\": []", "'accessors' stands twice"},
        {", \"materials\": {}", "materials: must be an array, not an object"},
        {", \"materials\": [1]", "materials[0]: must be an object, not 1"},
        {", \"materials\": [{\"name\": 1}]", "materials[0].name: must be a text, not 1"},
        {", \"materials\": [{\"doubleSided\": 1}]", "must be true or false, not 1"},
        {", \"materials\": [{\"emissiveFactor\": [1, 2]}]", "must be 3 numbers, not 2"},
        {", \"materials\": [{\"emissiveFactor\": [1, 2, \"3\"]}]", "must be a number"},
    };
    for (const Case& c : cases) {
        INFO(c.extra);
        CHECK_THAT(error_of(with(&Parts::extra, c.extra)), Catch::Contains(c.culprit));
    }
}

TEST_CASE("foreign names are escaped and cut in sentences") {
    const std::string error = error_of(with(
        &Parts::extra, ", \"extensionsRequired\": [\"\\u001b[31m" + std::string(200, 'x') + "\"]"));
    CHECK_THAT(error, Catch::Contains("\\x1b[31m"));
    CHECK(error.find('\x1b') == std::string::npos);
    CHECK(error.size() < 300);
}

TEST_CASE("JSON that would take more memory than a load may is refused") {
    ScratchFolder folder;
    folder.write("t.bin", Parts().bytes);
    std::string list = "0";
    for (int i = 0; i < 100000; ++i) list += ",0";
    const auto path =
        folder.write("evil.gltf", with(&Parts::extra, ", \"extras\": [" + list + "]").json());
    CHECK_THROWS_WITH(load_scene(path, {.limit = 1 << 20}), Catch::Contains("--load-limit"));
    CHECK_NOTHROW(load_scene(path, {.limit = 1 << 24}));
}

TEST_CASE("damaged binary glTF containers are refused") {
    const std::string json = Parts().json();
    const std::string bin = little_endian(44) + std::string("BIN\0", 4) + Parts().bytes + "\0\0";
    struct Case {
        std::string bytes, culprit;
    };
    const Case cases[] = {
        {"", "shorter"},
        {"glTF", "shorter"},
        {"PK\3\4 this is no glTF at all", "glTF"},
        {glb(json, "", 5000000), "truncated"},
        {glb(json, "", 0, 4000000000u), "overruns"},
        {glb(json, little_endian(0xfffffff0u) + std::string("BIN\0", 4)), "overruns"},
        {glb(json, "").substr(0, 300), "truncated"},
        {glb("{", ""), "not valid JSON at line 1, column"},
    };
    for (const Case& c : cases) {
        ScratchFolder folder;
        const std::string error = load_error(folder.write("evil.glb", c.bytes));
        CHECK_THAT(error, Catch::Contains("evil.glb"));
        CHECK_THAT(error, Catch::Contains(c.culprit));
    }
}
