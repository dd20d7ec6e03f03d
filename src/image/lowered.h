// Pictures of textures with fewer texels.
#pragma once

#include "image/image.h"

namespace onde {

/// A picture of that size, no side of which is larger: each texel is the mean, by area, of those
/// that it covers. `srgb` says that the codes of colours are to be linearised for that.
TexelImage lowered(const TexelImage& image, uint32_t width, uint32_t height, bool srgb);

} // namespace onde
