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

/// Something of a scene that is to keep its shape: a triangle, a shape, what a camera looks at.
struct Detail {
    glm::dvec3 middle;
    double size;         ///< half its diagonal
    double weight = 1.0; ///< the triangles that it stands for
};

/// How many times its size a detail may lie from where positions are counted: a float there is
/// off by a 128th of it.
inline constexpr double FAR_FOR_SIZE = 131072.0;

/// The box of a scene, half the diagonal of the smallest thing in it, and some of its details.
struct SceneExtent {
    Extent all;
    double smallest = std::numeric_limits<double>::infinity();
    std::vector<Detail> details{};

    void add(const Extent& thing);
};

/// Of its cameras too: what they look at weighs as much as all that there is.
SceneExtent extent_of(const Scene& scene);
SceneExtent extent_of_scene(std::span<const glm::dvec3> positions,
                            std::span<const glm::uvec3> triangles);

/// As origin_of() of the box; but where most details would lose their shape there, as those of a
/// scene that one stray thing ties to 0, the point near a detail that keeps the most.
glm::dvec3 origin_of(const SceneExtent& scene);

/// Some of a mesh's triangles, `most` at the most, evenly spread among them.
std::vector<Detail> details_of(std::span<const glm::dvec3> positions,
                               std::span<const glm::uvec3> triangles, size_t most);
std::vector<Detail> details_of(const Mesh& mesh, size_t most);
std::vector<Detail> details_of(const Scene& scene);
/// Of a mesh that is placed as one of `instances`.
size_t most_details(size_t instances);
Detail transformed(const Detail& detail, const glm::dmat4& transform);

/// What lies so far from where positions are counted that floats have no digits for its shape, and
/// the share of all details that it stands for; weight 0 where nothing does.
Detail torn_detail(std::span<const Detail> details);

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
