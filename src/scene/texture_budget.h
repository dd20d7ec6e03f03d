// What textures may take on the device.
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace onde {

/// A picture is not halved whose longer side has no more texels than this.
inline constexpr uint32_t LEAST_TEXTURE_SIDE = 64;

/// Halves the pictures of textures, the largest first, until all take no more than `bytes` on the
/// device, or none is left that may be halved; a note says so. Means stay as they are, but for the
/// rounding of codes.
void lower_textures(Scene& scene, uint64_t bytes);

} // namespace onde
