// Runs of the program on a glTF file in which something slides right and up within a second.
#pragma once

#include "onde_process.h"
#include "support/folders.h"

namespace onde::test {

inline const std::string SLIDE = in_project("tests/data/motion/slide.gltf");

/// Renders its second scene.
inline Arguments slide(const char* samples, const Arguments& more) {
    Arguments all{"--scene", "1", "--size", "64x48", "--spp", samples, "--float"};
    all.insert(all.end(), more.begin(), more.end());
    return render(SLIDE, all);
}

} // namespace onde::test
