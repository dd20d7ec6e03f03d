// Where a scene lies far from 0 for its size, floats have no digits left for its shape. Its
// positions are then counted from a point near it, in double precision, before they become floats.
#pragma once

#include "scene/detail.h"
#include "scene/extent.h"

#include <glm/glm.hpp>

#include <limits>
#include <span>
#include <vector>

namespace onde {

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

/// The box of a scene, half the diagonal of the smallest thing in it, and some of its details.
struct SceneExtent {
    Extent all;
    double smallest = std::numeric_limits<double>::infinity();
    std::vector<Detail> details{};

    void add(const Extent& thing);
};

/// Of its cameras too: what they look at weighs as much as all that there is.
SceneExtent extent_of(const Scene& scene);
/// Of a scene that is these triangles.
SceneExtent scene_extent_of(std::span<const glm::dvec3> positions,
                            std::span<const glm::uvec3> triangles);

/// As origin_of() of the box; but where most details would lose their shape there, as those of a
/// scene that one stray thing ties to 0, the point near a detail that keeps the most.
glm::dvec3 origin_of(const SceneExtent& scene);

/// Counts all of a scene from another origin than its own.
void count_from(const glm::dvec3& origin, Scene& scene);

/// The position in floats. A function of its own, as GCC 12 takes some of the numbers of
/// dvec3(vec3(position)) unrounded where it sees both steps.
glm::vec3 rounded(const glm::dvec3& position);

/// The positions counted from the origin; those that are not finite stay so.
std::vector<glm::vec3> counted_from(const glm::dvec3& origin,
                                    std::span<const glm::dvec3> positions);

} // namespace onde
