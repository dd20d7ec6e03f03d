// Lines at random, evenly over all that meet a ball: of those, a convex body inside is met by the
// share that its surface is of the ball's (Cauchy and Crofton).
#pragma once

#include "chapter/volume_tester.h"

namespace onde {

/// Rays that start before the ball and go along such lines; the same for the same seed.
std::vector<VolumeRay> random_lines(glm::vec3 center, float radius, size_t count, uint64_t seed);

} // namespace onde
