// Points that show how far a scene reaches.
#pragma once

#include "scene/load.h"

#include <functional>

namespace onde {

using VisitPoint = std::function<void(glm::vec3)>;

/// Visits every corner in the world of every triangle; of meshes that are placed more than once,
/// the corners of their boxes, for speed.
void visit_meshes(const Scene& scene, const VisitPoint& visit);

/// The same, and points of all spheres and shapes whose hull is at most half a percent smaller than
/// a sphere, and no smaller than other shapes.
void visit_outline(const Scene& scene, const VisitPoint& visit);

/// The box of a shape in its object space.
SceneBounds canonical_box(const Shape& shape);

} // namespace onde
