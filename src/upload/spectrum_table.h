// The table of shared/spectrum.h.
#pragma once

#include "shared/spectrum.h"

#include <vector>

namespace onde {

/// SPECTRUM_KNOTS of daylight (D65), from violet to red. Colours that sRGB does not have lose what
/// is negative of them, and all together are white.
std::vector<SpectrumKnot> spectrum_table();

} // namespace onde
