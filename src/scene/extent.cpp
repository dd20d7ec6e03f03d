#include "scene/extent.h"

#include "scene/outline.h"

namespace onde {

glm::dvec3 middle_of(const Extent& box) {
    return 0.5 * box.low + 0.5 * box.high;
}

double half_diagonal(const Extent& box) {
    return 0.5 * glm::length(box.high - box.low);
}

Extent transformed(const Extent& box, const glm::dmat4& transform) {
    Extent result;
    if (box.empty()) return result;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point(corner & 1 ? box.high.x : box.low.x,
                               corner & 2 ? box.high.y : box.low.y,
                               corner & 4 ? box.high.z : box.low.z);
        result.grow(glm::dvec3(transform * glm::dvec4(point, 1.0)));
    }
    return result;
}

/// Of triangles that can be hit: exporters leave stray ones without area at 0.
template <class Positions>
static Extent extent_of_triangles(const Positions& positions,
                                  std::span<const glm::uvec3> triangles) {
    Extent extent;
    for (const glm::uvec3& triangle : triangles) {
        const glm::dvec3 a(positions[triangle.x]), b(positions[triangle.y]);
        const glm::dvec3 c(positions[triangle.z]);
        if (glm::cross(b - a, c - a) == glm::dvec3(0.0)) continue;
        for (const glm::dvec3& corner : {a, b, c}) extent.grow(corner);
    }
    return extent;
}

Extent extent_of(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles) {
    return extent_of_triangles(positions, triangles);
}

Extent extent_of(const Mesh& mesh) {
    return extent_of_triangles(mesh.positions, mesh.triangles);
}

Extent extent_of(const Sphere& sphere) {
    const glm::dvec3 center(sphere.center);
    return {center - double(sphere.radius), center + double(sphere.radius)};
}

Extent extent_of(const Shape& shape) {
    const SceneBounds box = canonical_box(shape);
    return transformed({glm::dvec3(box.low), glm::dvec3(box.high)},
                       glm::dmat4(shape.object_to_world));
}

} // namespace onde
