// How photometric lights shine, as the words of shared/profile.h.
#pragma once

#include "scene/light.h"

#include <cstdint>
#include <vector>

namespace onde {

/// The words of a profile, its values in W/sr.
std::vector<uint32_t> pack_profile(const LightProfile& profile);

/// The mean of its values over all directions, W/sr.
double mean_of(const LightProfile& profile);

/// 1 - cosine of the angle to its axis beyond which it is dark; 0 if it is so everywhere.
float opening_of(const LightProfile& profile);

} // namespace onde
