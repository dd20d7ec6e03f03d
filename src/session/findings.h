// What a render has found, in sentences.
#pragma once

#include "render/sampled_pixels.h"

#include <string>

namespace onde {

/// `share`: of all light, that the clamp has cut off.
std::string clamp_sentence(float clamp, double share);

/// How many samples pixels took, and how many are off by more than `target`.
std::string noise_sentence(const NoiseReport& report, float target);

} // namespace onde
