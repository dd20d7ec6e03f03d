// One sample of one pixel, replayed on the device with everything that happened on its way.
#pragma once

#include "render/integrator.h"

#include "shared/inspect.h"

#include <glm/glm.hpp>

namespace onde {

struct PixelSample {
    uint32_t x = 0, y = 0; ///< from the upper left
    uint32_t sample = 0;
};

/// A ray tree. The root is nodes[0]; a node's children follow in the order in which they are added.
struct TreeReport {
    std::vector<NodeReport> nodes;
    std::vector<std::vector<SourceReport>> sources; ///< by node; empty on a miss
};

/// A path, bounce by bounce.
struct PathReport {
    std::vector<BounceReport> bounces;
    glm::vec3 radiance{0.0f}; ///< of the sample
};

/// The root's returned colour is the sample that a render of the same options adds to the film, bit
/// for bit. Throws InputError when the pixel lies outside the picture or the tree has more than
/// 65536 nodes.
TreeReport inspect_whitted(const IntegratorContext& context, const PixelSample& at);

/// The radiance is the sample that a render of the same options adds to the film, bit for bit.
/// Throws InputError when the pixel lies outside the picture.
PathReport inspect_path(const IntegratorContext& context, const PixelSample& at);

} // namespace onde
