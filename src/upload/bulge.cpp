#include "upload/bulge.h"

#include <algorithm>
#include <cmath>

namespace onde {

uint32_t encode_bulge(const glm::vec3 (&corners)[3], const glm::vec3 (&normals)[3],
                      glm::vec3 geometric) {
    constexpr double MOST_UNITS = 127.0;
    double edge[3], most = 0.0;
    glm::dvec3 up[3];
    for (int k = 0; k < 3; k++)
        up[k] = glm::dvec3(glm::dot(normals[k], geometric) < 0 ? -normals[k] : normals[k]);
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3;
        edge[k] = glm::dot(glm::dvec3(corners[k]) - glm::dvec3(corners[next]), up[k] - up[next]);
        most = std::max(most, std::abs(edge[k]));
    }
    if (!(most > 0.0) || !std::isfinite(most)) return 0;
    int exponent = 0;
    std::frexp(most / MOST_UNITS, &exponent);
    exponent = std::clamp(exponent + 127, 1, 254);
    const double unit = std::ldexp(1.0, exponent - 127);
    uint32_t word = uint32_t(exponent) << 24;
    for (int k = 0; k < 3; k++) {
        const double units = std::copysign(std::ceil(std::abs(edge[k]) / unit), edge[k]);
        word |= uint32_t(128 + int(std::clamp(units, -MOST_UNITS, MOST_UNITS))) << (8 * k);
    }
    return word;
}

} // namespace onde
