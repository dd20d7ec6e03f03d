// Volume and surface of bounding volumes: a polytope is cut out face by face.
#include "accel/volumes.h"

#include <numbers>
#include <vector>

namespace onde {

namespace {

/// The points with normal . p <= offset; the normal is of unit length.
struct HalfSpace {
    glm::dvec3 normal;
    double offset;
};

using Polygon = std::vector<glm::dvec3>;

/// After Sutherland and Hodgman, "Reentrant polygon clipping", 1974.
Polygon clipped(const Polygon& polygon, const HalfSpace& side) {
    Polygon inside;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double from_a = side.offset - glm::dot(side.normal, a);
        const double from_b = side.offset - glm::dot(side.normal, b);
        if (from_a >= 0) inside.push_back(a);
        if ((from_a < 0) != (from_b < 0))
            inside.push_back(a + (b - a) * (from_a / (from_a - from_b)));
    }
    return inside;
}

/// A square in the plane, larger than anything of that size around the origin.
Polygon large_square(const HalfSpace& plane, double size) {
    const glm::dvec3 n = plane.normal;
    const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 s = glm::normalize(glm::cross(n, other)) * size, t = glm::cross(n, s);
    const glm::dvec3 center = plane.offset * n;
    return {center - s - t, center + s - t, center + s + t, center - s + t};
}

double area_of(const Polygon& polygon) {
    glm::dvec3 sum(0.0);
    for (size_t i = 2; i < polygon.size(); ++i)
        sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * glm::length(sum);
}

/// Of the intersection of half-spaces that all contain the origin.
VolumeMeasure measure(const std::vector<HalfSpace>& sides, double size) {
    VolumeMeasure total;
    for (const HalfSpace& face : sides) {
        Polygon polygon = large_square(face, size);
        for (const HalfSpace& side : sides)
            if (&side != &face) polygon = clipped(polygon, side);
        const double area = area_of(polygon);
        total.area += area;
        total.volume += area * face.offset / 3;
    }
    return total;
}

} // namespace

VolumeMeasure measure_volume(const BoxVolume& box) {
    glm::dvec3 s;
    for (glm::length_t k = 0; k < 3; ++k) s[k] = double(box.high[k]) - double(box.low[k]);
    return {s.x * s.y * s.z, 2 * (s.x * s.y + s.y * s.z + s.z * s.x)};
}

VolumeMeasure measure_volume(const OrientedBoxVolume& box) {
    BoxVolume upright{};
    for (int k = 0; k < 3; ++k) upright.low[k] = box.low[k], upright.high[k] = box.high[k];
    return measure_volume(upright);
}

VolumeMeasure measure_volume(const SlabsVolume& slabs, uint32_t count) {
    glm::dvec3 middle;
    double size = 0;
    for (glm::length_t k = 0; k < 3; ++k) {
        middle[k] = 0.5 * (double(slabs.low[k]) + double(slabs.high[k]));
        size += double(slabs.high[k]) - double(slabs.low[k]);
    }
    std::vector<HalfSpace> sides;
    for (uint32_t k = 0; k < count; ++k) {
        const glm::dvec3 normal(SLAB_NORMALS[k]);
        const double length = glm::length(normal), at = glm::dot(normal, middle);
        sides.push_back({normal / length, (double(slabs.high[k]) - at) / length});
        sides.push_back({-normal / length, (at - double(slabs.low[k])) / length});
    }
    return measure(sides, 4 * size);
}

VolumeMeasure measure_volume(const SphereVolume& sphere) {
    const double r = sphere.radius;
    return {4.0 / 3.0 * std::numbers::pi * r * r * r, 4 * std::numbers::pi * r * r};
}

} // namespace onde
