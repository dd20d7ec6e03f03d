// Where a scene lies far from 0 for its size, floats have no digits left for its shape. Its
// positions are then counted from a point near it, in double precision, before they become floats.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

#include <limits>
#include <span>
#include <vector>

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

/// The box around a transformed box, or an empty one of an empty one.
Extent transformed(const Extent& box, const glm::dmat4& transform);

/// Half diagonals of its box from 0 at which a scene, and the mesh of a skin, lies far out.
inline constexpr double FAR_SCENE = 32.0, FAR_SKIN = 1024.0;

/// A scene lies far out as well at so many half diagonals of its box, and so many of its smallest
/// thing: on a large ground there may be small things.
inline constexpr double FAR_GROUND = 4.0, FAR_DETAIL = 1024.0;

/// The point from which positions in the box are counted: 0, but a point near the middle of a box
/// that lies more than `far` times its half diagonal from 0. Its coordinates are multiples of a
/// power of two that is not below the half diagonal, so that nothing is rounded when they are
/// subtracted.
glm::dvec3 origin_of(const Extent& box, double far = FAR_SCENE);

/// The box of a scene, and half the diagonal of the smallest thing in it.
struct SceneExtent {
    Extent all;
    double smallest = std::numeric_limits<double>::infinity();

    void add(const Extent& thing);
};

SceneExtent extent_of(const Scene& scene);
glm::dvec3 origin_of(const SceneExtent& scene);

/// Counts all of a scene from another origin than its own.
void count_from(const glm::dvec3& origin, Scene& scene);

/// The box of a mesh.
Extent extent_of(const Mesh& mesh);

/// The box of the positions that triangles name.
Extent extent_of(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles);

/// The position in floats. A function of its own, as GCC 12 takes some of the numbers of
/// dvec3(vec3(position)) unrounded where it sees both steps.
glm::vec3 rounded(const glm::dvec3& position);

/// The positions counted from the origin; those that are not finite stay so.
std::vector<glm::vec3> counted_from(const glm::dvec3& origin,
                                    std::span<const glm::dvec3> positions);

} // namespace onde
