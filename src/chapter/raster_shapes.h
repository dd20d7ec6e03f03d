// Analytic shapes as fine meshes, for the integrators that draw triangles.
#pragma once

#include "scene/scene.h"

namespace onde {

/// Segments of a full turn. A circle of radius r lies at most r (1 - cos(pi / 256)), that is
/// 7.5e-5 r, outside its polygon.
inline constexpr uint32_t SHAPE_SEGMENTS = 256;

/// The canonical shape (see Shape) in its object space, its corners on the surface.
Mesh shape_mesh(const Shape& shape);

} // namespace onde
