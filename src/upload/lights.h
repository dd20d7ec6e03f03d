// The list of everything that emits, with the probability of choosing each.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"
#include "upload/geometry.h"

#include <vector>

namespace onde {

struct LightList {
    std::vector<LightRecord> records;
    uint32_t environment = NO_INDEX; ///< its index, if it emits
};

/// Lights in the order: emissive primitives, points, directions, environment. The probability of
/// each is proportional to an estimate of its power in the scene. Light from infinity counts at
/// most as much as all the rest together, the environment at least a third of that: a large floor
/// must not draw all samples to a dim sky. Triangles whose emission texture is black are not
/// listed. Sets the light of the surfaces.
LightList build_lights(const Scene& scene, FlatGeometry& flat);

} // namespace onde
