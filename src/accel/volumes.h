// Bounding volumes fitted around points (the chapter's C12). Each contains every point exactly, as
// floats are rounded outward; the device's ray tests are in kernels/chapter/volumes.h.
#pragma once

#include "shared/volumes.h"

#include <glm/glm.hpp>

#include <array>
#include <span>

namespace onde {

/// The normals of SlabsVolume, in its order; not of unit length.
extern const std::array<glm::vec3, MANY_SLABS> SLAB_NORMALS;

/// All take at least one point, with finite coordinates.
BoxVolume fit_box(std::span<const glm::vec3> points);

/// The box of least volume among those along the axes, along the principal directions of the
/// points, and along what turning either of them by ever smaller angles improves.
OrientedBoxVolume fit_oriented_box(std::span<const glm::vec3> points);

/// All MANY_SLABS slabs; with fewer, a test looks at the first ones only.
SlabsVolume fit_slabs(std::span<const glm::vec3> points);

/// The smallest sphere, to about a millionth of its radius.
SphereVolume fit_sphere(std::span<const glm::vec3> points);

/// How large a volume is.
struct VolumeMeasure {
    double volume = 0, area = 0;
};

VolumeMeasure measure_volume(const BoxVolume& box);
VolumeMeasure measure_volume(const OrientedBoxVolume& box);
/// Of the first `count` slabs.
VolumeMeasure measure_volume(const SlabsVolume& slabs, uint32_t count);
VolumeMeasure measure_volume(const SphereVolume& sphere);

} // namespace onde
