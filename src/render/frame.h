// The FrameRecord of a camera and options.
#pragma once

#include "render/options.h"
#include "shared/frame.h"
#include "upload/pack.h"

#include <vector>

namespace onde {

/// Throws InputError when the camera's screen (C3) has no square pixels in a picture of the
/// options' size, with both numbers, and where their integrator has parallel rays and the camera is
/// wide.
void check_view(const Camera& camera, const RenderOptions& options);

FrameRecord make_frame(const PackedScene& scene, const Camera& camera,
                       const RenderOptions& options);

/// That, and of films with motion that of the next frame behind it.
std::vector<FrameRecord> make_frames(const PackedScene& scene, const Camera& camera,
                                     const RenderOptions& options);

/// Every pixel of a rectangle as x | y << 16: 8x8 tiles row by row, Morton order inside, so that
/// neighbours in a wave are neighbours in the picture.
std::vector<uint32_t> pixel_order(const Rectangle& rectangle);

/// Those of the whole film.
std::vector<uint32_t> pixel_order(uint32_t width, uint32_t height);

} // namespace onde
