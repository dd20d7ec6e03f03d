// The light of scenes that bring none.
#pragma once

#include "image/image.h"

namespace onde {

/// A grey gradient, brighter above, with a key light from the upper left of the framing camera, a
/// fill from its right and a rim from behind. A white, diffuse ball in it is displayed at about
/// 0.8.
Image studio_map();

} // namespace onde
