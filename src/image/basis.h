// Basis Universal's transcoder: a library of its own, opened where it is present.
// tools/basis/build.sh builds it.
#pragma once

#include "image/stored_image.h"

namespace onde {

/// The largest level of a KTX2 file of ETC1S or UASTC texels as RGBA, 4 * width * height bytes.
/// Throws ImageProblem where the transcoder is absent or gives up.
std::vector<uint8_t> transcode_basis(FileBytes file, uint32_t width, uint32_t height);

} // namespace onde
