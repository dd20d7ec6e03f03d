// One picture of two: colours, and the opacity that MTL files keep apart.
#pragma once

#include "image/image.h"

namespace onde {

/// The colours of `color` (white where it is empty) with the alpha that `opacity` says: its own
/// where it has one, else its red. As large as the larger of the two on each side; texels are
/// repeated where the other is smaller.
ByteImage with_opacity(const ByteImage& color, const ByteImage& opacity);

} // namespace onde
