// Angles as files give them: of any number of turns.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace onde {

/// The same direction in radians. More than a turn is taken off in degrees, where a turn is a whole
/// number and nothing is lost; up to one the angle stays as it is.
inline float radians_of(float degrees) {
    if (std::abs(degrees) > 360.0f) degrees = std::remainder(degrees, 360.0f);
    return glm::radians(degrees);
}

inline double radians_of(double degrees) {
    return glm::radians(std::remainder(degrees, 360.0));
}

inline glm::dvec3 radians_of(const glm::dvec3& degrees) {
    return {radians_of(degrees.x), radians_of(degrees.y), radians_of(degrees.z)};
}

inline glm::vec3 radians_of(const glm::vec3& degrees) {
    return {radians_of(degrees.x), radians_of(degrees.y), radians_of(degrees.z)};
}

} // namespace onde
