// Pixel filters as distributions of sample positions.
#pragma once

#include "scene/scene.h"
#include "shared/frame.h"

#include <array>

namespace onde {

/// Inverse cumulative distribution of a filter along one axis, at FILTER_TABLE_SIZE equal steps of
/// probability: offsets from the pixel's centre, in pixels. Box: half a pixel; tent: 1; Gaussian:
/// sigma 0.5 within 1.5; Blackman-Harris: within 1.5 (Harris 1978, the 4-term window).
std::array<float, FILTER_TABLE_SIZE> filter_table(Filter filter);

/// Half the width of the filter, in pixels.
double filter_radius(Filter filter);

/// The filter's unnormalised value at an offset from the pixel's centre.
double filter_value(Filter filter, double offset);

} // namespace onde
