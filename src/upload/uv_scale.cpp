#include "upload/uv_scale.h"

#include <algorithm>
#include <cmath>

namespace onde {

float uv_scale(const glm::vec3 (&corners)[3], const glm::vec2 (&uvs)[3]) {
    const glm::dvec3 a = glm::dvec3(corners[1]) - glm::dvec3(corners[0]);
    const glm::dvec3 b = glm::dvec3(corners[2]) - glm::dvec3(corners[0]);
    const double along = glm::length(a), area = glm::length(glm::cross(a, b));
    if (!(area > 0)) return 0.0f;
    // In a basis of the plane whose first axis is that of a, a is (along, 0) and b is:
    const glm::dvec2 b_in_plane(glm::dot(a, b) / along, area / along);
    const glm::dvec2 du = (glm::dvec2(uvs[1]) - glm::dvec2(uvs[0])) / along;
    const glm::dvec2 dv =
        (glm::dvec2(uvs[2]) - glm::dvec2(uvs[0]) - du * b_in_plane.x) / b_in_plane.y;
    const double determinant = std::abs(du.x * dv.y - du.y * dv.x);
    const double sum = glm::dot(du, du) + glm::dot(dv, dv); // of the squares of both values
    const double larger = std::sqrt(
        0.5 * (sum + std::sqrt(std::max(sum * sum - 4 * determinant * determinant, 0.0))));
    const double smaller = determinant / larger;
    return std::isfinite(smaller) ? float(smaller) : 0.0f;
}

} // namespace onde
