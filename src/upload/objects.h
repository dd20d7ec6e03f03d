// Which thing of a scene a hit is of. The things are counted as objects: the scene's instances,
// then its spheres, then its shapes.
#pragma once

#include "shared/scene.h"

#include <cstdint>
#include <vector>

namespace onde {

struct ObjectMap {
    /// Primitives from this one on are of that object, where hits have no instance.
    struct Run {
        uint32_t first_primitive = 0, object = 0;
    };
    std::vector<Run> runs;              ///< ascending
    std::vector<uint32_t> of_placement; ///< NO_INDEX for the placement of what is baked

    /// instance: of the hit, or NO_INDEX.
    uint32_t operator()(uint32_t primitive, uint32_t instance) const;
};

} // namespace onde
