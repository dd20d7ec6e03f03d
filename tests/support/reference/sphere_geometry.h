// Exact spheres as an Embree user geometry: the quadratic is solved in double precision.
#pragma once

#include "scene/scene.h"

#include <embree3/rtcore.h>

#include <span>

namespace onde::reference {

/// A geometry, not yet committed, that refers to `spheres` for as long as it lives.
RTCGeometry new_sphere_geometry(RTCDevice device, std::span<const Sphere> spheres);

} // namespace onde::reference
