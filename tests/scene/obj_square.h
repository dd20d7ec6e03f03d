// An OBJ file of one square with its library, to which a test adds what it is about.
#pragma once

#include "scratch.h"

namespace onde::test {

inline const std::string SQUARE = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                                  "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
inline const std::string FACE = "f 1/1 2/2 3/3 4/4\n";
inline const std::string RED = "newmtl a\nKd 0.8 0.1 0.1\n";
inline const glm::vec3 RED_COLOR(0.8f, 0.1f, 0.1f);

/// The scene of an OBJ beside "m.mtl", RED unless given, and "t.png".
inline Scene load(const std::string& obj, const std::string& mtl = RED) {
    ScratchFolder folder;
    folder.write("m.mtl", mtl);
    folder.write("t.png", blue_png());
    return load_scene(folder.write("a.obj", obj));
}

inline const Material& material_of(const Scene& scene, size_t triangle = 0) {
    return scene.materials.at(scene.meshes.at(0).materials.at(triangle));
}

} // namespace onde::test
