#include "upload/triangle_plane.h"

#include <algorithm>
#include <cmath>

namespace onde {

static uint32_t exponent_above(double length) {
    int exponent = 0;
    std::frexp(length, &exponent);
    return uint32_t(std::clamp(exponent + 127, 1, 254));
}

/// Corners and edges are rounded, and traversal computes the normal from the edges: of a narrow
/// triangle it is off by the edges' length over the triangle's height.
TrianglePlane triangle_plane(const glm::vec3 (&p)[3], float orientation) {
    constexpr double MOST_NARROW = 64.0; // narrower ones are hardly hit
    const glm::dvec3 a(p[0]), b(p[1]), c(p[2]);
    const glm::dvec3 across = glm::cross(b - a, c - a) * double(orientation);
    const double area2 = glm::length(across);
    TrianglePlane plane{glm::vec3(0, 0, 1), 0.0f, 0};
    if (area2 > 0.0 && std::isfinite(area2)) plane.normal = glm::vec3(across / area2);
    plane.offset = float(glm::dot(glm::dvec3(plane.normal), (a + b + c) / 3.0));
    const double edge = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    const double narrow = area2 > 0.0 ? std::min(edge * edge / area2, MOST_NARROW) : MOST_NARROW;
    const glm::vec3 far = glm::max(glm::max(glm::abs(p[0]), glm::abs(p[1])), glm::abs(p[2]));
    plane.reach = exponent_above(double(std::max({far.x, far.y, far.z})) + edge * narrow);
    return plane;
}

} // namespace onde
