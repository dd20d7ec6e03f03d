// The camera of scenes that bring none.
#pragma once

#include "scene/scene.h"

namespace onde {

/// The share of the picture's tighter side that the subject fills.
inline constexpr float FRAMED_SHARE = 0.885f;

/// From the front (+Z), a little from the right and from above, as near as the whole scene fits
/// into that share of a picture of this size in pixels.
Camera framing_camera(const Scene& scene, glm::uvec2 size);

} // namespace onde
