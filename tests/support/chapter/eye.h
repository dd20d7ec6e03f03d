// Where camera rays start, and the points at which pixels and sources are sampled.
#pragma once

#include "support/chapter/solids.h"

namespace onde::chapter {

/// Element `index` of the R2 sequence, both in [0, 1).
glm::dvec2 r2_sample(uint32_t index);

/// The ray through `film`, in pixels from the upper left corner of a film of `size` pixels; its
/// direction is unit.
Ray camera_ray(const Camera& camera, glm::uvec2 size, const glm::dvec2& film);

} // namespace onde::chapter
