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

    /// As definitions for the kernels: "ONDE_TRANSLUCENT=1", ...
    std::vector<std::string> defines() const;
};

/// depth: the levels of a ray tree, in [1, MAX_TREE_DEPTH].
PackedWhitted pack_whitted(const Scene& scene, uint32_t depth);

} // namespace onde
