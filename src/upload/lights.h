// The list of everything that emits, with the probability of choosing each.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"
#include "upload/environment.h"
#include "upload/geometry.h"

#include <vector>

namespace onde {

/// How lights are sampled; pictures have the same mean whatever it says.
struct LightOptions {
    LightSampler sampler = LightSampler::automatic;
    double compensation = MIS_COMPENSATION; ///< of the environment's map
};

/// Directional lights that have a size.
struct SunRange {
    uint32_t first = 0, count = 0;
};

struct LightList {
    std::vector<LightRecord> records;
    std::vector<LightBranch> tree;   ///< empty: lights are chosen by their power
    std::vector<uint32_t> profiles;  ///< of photometric lights
    uint32_t environment = NO_INDEX; ///< its index, if it emits
    SunRange suns;                   ///< among the records
};

/// Lights in the order: emissive primitives, those without size, directions, suns, environment. The
/// probability of each is proportional to an estimate of its power in the scene. Light from
/// infinity counts at most as much as all the rest together, the environment at least a third of
/// that: a large floor must not draw all samples to a dim sky. Triangles whose emission texture is
/// black are not listed. Sets the light of the surfaces.
LightList build_lights(const Scene& scene, FlatGeometry& flat,
                       LightSampler sampler = LightSampler::automatic);

} // namespace onde
