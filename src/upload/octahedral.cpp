#include "upload/octahedral.h"

#include <cmath>

namespace onde {

uint32_t encode_octahedral(glm::vec3 v) {
    const float sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    if (!(sum > 0.0f)) return 0;
    float x = v.x / sum, y = v.y / sum;
    if (v.z < 0.0f) {
        const float folded_x = (1.0f - std::abs(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        y = (1.0f - std::abs(x)) * (y >= 0.0f ? 1.0f : -1.0f);
        x = folded_x;
    }
    const auto quantize = [](float a) {
        return uint32_t(uint16_t(int16_t(std::lround(a * 32767.0f))));
    };
    return quantize(x) | quantize(y) << 16;
}

glm::vec3 unit_or(glm::vec3 v, glm::vec3 fallback) {
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length) ? v / length : fallback;
}

} // namespace onde
