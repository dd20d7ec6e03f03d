// `onde render --turntable`: pictures of a camera that goes round the scene.
#pragma once

#include "scene/load.h"

#include <filesystem>

namespace onde::app {

/// The most pictures of a turn.
inline constexpr uint32_t MOST_TURNTABLE_PICTURES = 9999;

/// The camera turned about the vertical axis through the middle of the bounds, counter-clockwise
/// seen from above.
Camera turned_camera(const Camera& camera, const SceneBounds& bounds, double radians);

/// Where picture `number` of a turn goes: 7 of out.png to out.0007.png.
std::filesystem::path numbered_path(const std::filesystem::path& output, uint32_t number);

} // namespace onde::app
