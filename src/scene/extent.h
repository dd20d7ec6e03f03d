// Boxes around things of a scene, in double precision.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

#include <limits>
#include <span>

namespace onde {

/// A box that grows, in double precision.
struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void grow(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    bool empty() const { return !(low.x <= high.x); }
};

glm::dvec3 middle_of(const Extent& box);
double half_diagonal(const Extent& box);

/// The box around a transformed box, or an empty one of an empty one.
Extent transformed(const Extent& box, const glm::dmat4& transform);

/// The box of a mesh.
Extent extent_of(const Mesh& mesh);

/// The box of the positions that triangles name.
Extent extent_of(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles);

Extent extent_of(const Sphere& sphere);
Extent extent_of(const Shape& shape);

} // namespace onde
