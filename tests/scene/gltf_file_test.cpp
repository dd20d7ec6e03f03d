// What a glTF file may be made of: names, data URIs, numbers as exporters write them.
#include "gltf_quad.h"

using namespace onde;
using namespace onde::test;

TEST_CASE("a matrix whose last row is rounded is taken as affine") {
    const Scene scene = load_quad(quad_gltf(R"([{"mesh": 0, "matrix":
        [2, 0, 0, 1e-7, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 0.999999]}])"));
    const glm::mat4& m = scene.instances.at(0).object_to_world;
    CHECK(m[0] == glm::vec4(2, 0, 0, 0));
    CHECK(m[3] == glm::vec4(1, 2, 3, 1));
}

TEST_CASE("a plus in a URI is a plus, and a file may be longer than its buffer") {
    ScratchFolder folder;
    folder.write("a+b#c.bin", quad_bytes() + "spare");
    std::string gltf = quad_gltf();
    gltf.replace(gltf.find("quad.bin"), 8, "a+b%23c.bin");
    CHECK(load_scene(folder.write("q.gltf", gltf)).instances.size() == 1);
}

TEST_CASE("data URIs may have any media type, parameters and either coding") {
    // A triangle (0 0 0), (1 0 0), (0 1 0).
    const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    std::string escaped;
    for (unsigned char c : bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0})) {
        char text[4];
        std::snprintf(text, sizeof(text), "%%%02x", unsigned(c));
        escaped += text;
    }
    for (const std::string& uri :
         {"data:application/octet-stream;base64," + base64, "data:;base64," + base64,
          "data:model/x;charset=utf-8;x=\\\"1\\\";base64," + base64,
          "data:application/gltf-buffer," + escaped, "data:," + escaped}) {
        INFO(uri);
        ScratchFolder folder;
        const Scene scene = load_scene(folder.write("d.gltf", R"({"asset": {"version": "2.0"},
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "buffers": [{"byteLength": 36, "uri": ")" + uri + R"("}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}]})"));
        CHECK(scene.meshes.at(0).positions.at(2) == glm::vec3(0, 1, 0));
    }
}

TEST_CASE("whole numbers may be written with a fraction of zero") {
    std::string gltf = quad_gltf();
    gltf.replace(gltf.find("\"count\": 4"), 10, "\"count\": 4.0");
    CHECK(load_quad(gltf).meshes.at(0).positions.size() == 4);
}

TEST_CASE("what nothing uses may be missing") {
    std::string gltf = quad_gltf();
    gltf.replace(gltf.find("\"buffers\": ["), 12, "\"buffers\": [");
    const size_t end = gltf.find("}],\n  \"bufferViews\"");
    gltf.insert(end + 1, R"(, {"uri": "nowhere.bin", "byteLength": 4})");
    CHECK(load_quad(gltf).instances.size() == 1);
}

TEST_CASE("names with spaces and percent signs are decoded") {
    ScratchFolder folder;
    folder.write("my quad+.bin", quad_bytes());
    std::string gltf = quad_gltf();
    gltf.replace(gltf.find("quad.bin"), 8, "my%20quad%2B.bin");
    CHECK(load_scene(folder.write("q.gltf", gltf)).instances.size() == 1);
}
