#include "chapter/random_lines.h"

#include "chapter/numbers.h"

#include <cmath>
#include <numbers>

namespace onde {

std::vector<VolumeRay> random_lines(glm::vec3 center, float radius, size_t count, uint64_t seed) {
    constexpr float TURN = 2 * std::numbers::pi_v<float>;
    Numbers numbers(seed);
    std::vector<VolumeRay> rays(count);
    for (VolumeRay& ray : rays) {
        const float z = 1 - 2 * numbers.unit(), around = TURN * numbers.unit();
        const float r = std::sqrt(std::max(0.0f, 1 - z * z));
        const glm::vec3 d(r * std::cos(around), r * std::sin(around), z);
        const glm::vec3 other = std::abs(d.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        const glm::vec3 s = glm::normalize(glm::cross(d, other)), t = glm::cross(d, s);
        const float off = radius * std::sqrt(numbers.unit()), angle = TURN * numbers.unit();
        ray = {center + off * (std::cos(angle) * s + std::sin(angle) * t) - 2 * radius * d, d};
    }
    return rays;
}

} // namespace onde
