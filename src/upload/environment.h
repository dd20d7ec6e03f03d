// The environment map as device records.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

#include <cstdint>
#include <vector>

namespace onde {

struct PackedEnvironment {
    uint32_t width = 0, height = 0;   ///< 0 when the environment is constant
    std::vector<float> pixels;        ///< 3 per pixel, without the scale
    std::vector<AliasRecord> alias;   ///< MAP_TABLES per pixel
    float floor = 0;                  ///< the brightness that MAP_COMPENSATED takes off
    float scale[MAP_TABLES] = {1, 1}; ///< density over brightness, but for the map's jacobian
};

/// By how much of the mean brightness samples of the map are for what is brighter, where BSDFs are
/// sampled too; 0: for all. See pixel_weight in kernels/shade/environment.h.
inline constexpr double MIS_COMPENSATION = 0.5;

/// A pixel's weight is that of its tent, so that every direction with light, under bilinear
/// lookups, can be drawn from the whole table.
PackedEnvironment pack_environment(const Environment& environment,
                                   double compensation = MIS_COMPENSATION);

} // namespace onde
