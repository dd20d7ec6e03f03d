// What the Whitted kernels need of a scene beside its geometry and textures. Pure.
#pragma once

#include "scene/scene.h"
#include "shared/whitted.h"

#include <string>
#include <vector>

namespace onde {

struct PackedWhitted {
    WhittedRecord settings{};
    std::vector<PhongRecord> phong; ///< by material
    std::vector<SourceRecord> sources;
    bool translucent = false, dispersive = false;
    uint32_t depth = 1;

    /// As definitions for the kernels: "ONDE_TRANSLUCENT=1", ...
    std::vector<std::string> defines() const;
};

/// The levels that kernels for trees of this depth have room for: rounded up, so that scenes share
/// a compiled program.
uint32_t level_capacity(uint32_t depth);

/// depth: the levels of a ray tree, in [1, MAX_TREE_DEPTH].
PackedWhitted pack_whitted(const Scene& scene, uint32_t depth);

} // namespace onde
