// One picture of two: colours, and the opacity that files keep apart.
#pragma once

#include "image/image.h"

namespace onde {

/// Where a picture has its opacity.
enum class OpacityChannel { red, alpha_or_red };

/// The colours of `color` (white where it is empty) with the alpha that `opacity` says: its own
/// where it has one and that is wanted, else its red. As large as the larger of the two on each
/// side; texels are repeated where the other is smaller.
TexelImage with_opacity(const TexelImage& color, const TexelImage& opacity,
                        OpacityChannel wanted = OpacityChannel::alpha_or_red);

} // namespace onde
