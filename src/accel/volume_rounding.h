// From double to the float on the safe side.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace onde::accel {

inline float round_down(double a) {
    const auto nearest = float(a);
    return double(nearest) <= a ? nearest
                                : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}
inline float round_up(double a) {
    return -round_down(-a);
}

/// What the points cover along an axis.
struct Cover {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

inline Cover cover(std::span<const glm::vec3> points, glm::dvec3 axis) {
    Cover covered;
    for (const glm::vec3& point : points) {
        const double at = glm::dot(axis, glm::dvec3(point));
        covered.low = std::min(covered.low, at);
        covered.high = std::max(covered.high, at);
    }
    return covered;
}

/// The largest |x| + |y| + |z|.
inline float reach_of(std::span<const glm::vec3> points) {
    double reach = 0;
    for (const glm::vec3& p : points)
        reach =
            std::max(reach, std::abs(double(p.x)) + std::abs(double(p.y)) + std::abs(double(p.z)));
    return round_up(reach);
}

} // namespace onde::accel
