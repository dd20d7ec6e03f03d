// Where a line meets the chapter's shapes, from their equations.
#pragma once

#include "scene/scene.h"
#include "support/chapter/polynomial.h"

#include <glm/glm.hpp>

#include <optional>

namespace onde::chapter {

struct Ray {
    glm::dvec3 origin, direction;
    glm::dvec3 at(double t) const { return origin + t * direction; }
};

/// At origin + t * direction the line goes through a surface whose front looks along `normal`,
/// which need not be unit.
struct Crossing {
    double t;
    glm::dvec3 normal;
};
using Crossings = Few<Crossing, 8>;

/// All crossings with the canonical shape (see onde::Shape), before and behind the origin, in no
/// order. The direction has any length.
Crossings cross_shape(ShapeKind kind, double minor_radius, const Ray& ray);

/// As above, with the unit sphere.
Crossings cross_sphere(const Ray& ray);

/// The crossing with the triangle's plane, if it is within the triangle or on its border.
std::optional<Crossing> cross_triangle(const glm::dvec3 (&corners)[3], const Ray& ray);

} // namespace onde::chapter
