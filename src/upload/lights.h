// The list of everything that emits, with the probability of choosing each.
#pragma once

#include "core/enum_words.h"
#include "scene/scene.h"
#include "shared/scene.h"
#include "upload/environment.h"
#include "upload/geometry.h"

#include <vector>

namespace onde {

/// How paths choose one of many lights.
enum class LightSampler {
    automatic, ///< by the tree where there are many lights that have a place
    power,     ///< by their power, whatever is lit
    tree,      ///< by what they may send to the point that is lit
};

constexpr auto enum_words(LightSampler) {
    return std::array{EnumWord{LightSampler::automatic, "auto"},
                      EnumWord{LightSampler::power, "power"}, EnumWord{LightSampler::tree, "tree"}};
}

/// How lights are sampled; pictures have the same mean whatever it says.
struct LightOptions {
    LightSampler sampler = LightSampler::automatic;
    double compensation = MIS_COMPENSATION; ///< of the environment's map
};

struct LightList {
    std::vector<LightRecord> records;
    std::vector<LightBranch> tree;   ///< empty: lights are chosen by their power
    uint32_t environment = NO_INDEX; ///< its index, if it emits
};

/// Lights in the order: emissive primitives, points, directions, environment. The probability of
/// each is proportional to an estimate of its power in the scene. Light from infinity counts at
/// most as much as all the rest together, the environment at least a third of that: a large floor
/// must not draw all samples to a dim sky. Triangles whose emission texture is black are not
/// listed. Sets the light of the surfaces.
LightList build_lights(const Scene& scene, FlatGeometry& flat,
                       LightSampler sampler = LightSampler::automatic);

} // namespace onde
