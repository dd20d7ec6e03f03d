// A glTF file of one square, to which a test adds what it is about.
#pragma once

#include "scratch.h"

namespace onde::test {

/// A quad of 4 positions (48 bytes), then 6 16-bit indices (12 bytes), then 4 uvs (32 bytes).
inline std::string quad_bytes() {
    return bytes_of<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
           bytes_of<uint16_t>({0, 1, 2, 0, 2, 3}) + bytes_of<float>({0, 1, 1, 1, 1, 0, 0, 0});
}

/// A glTF file of that quad; `extra` goes into the root, `primitive` into its primitive, `nodes` is
/// the list of nodes, all of them roots.
inline std::string quad_gltf(const std::string& nodes = R"([{"mesh": 0}])",
                             const std::string& primitive = "", const std::string& extra = "",
                             const std::string& roots = "[0]") {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": )" + roots +
           R"(}], "nodes": )" + nodes + R"(, "meshes": [{"primitives": [{"indices": 1)" +
           primitive +
           R"(, "attributes": {"POSITION": 0, "TEXCOORD_0": 2}}]}],
  "buffers": [{"uri": "quad.bin", "byteLength": 92}],
  "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                  {"buffer": 0, "byteOffset": 60, "byteLength": 32}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}])" +
           extra + "}";
}

inline Scene load_quad(const std::string& gltf) {
    ScratchFolder folder;
    folder.write("quad.bin", quad_bytes());
    folder.write("blue.png", blue_png());
    return load_scene(folder.write("quad.gltf", gltf));
}

} // namespace onde::test
