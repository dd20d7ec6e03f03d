// Vertex colours of OBJ and PLY files, which are sRGB as pictures are.
#pragma once

#include "image/tone.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace onde {

/// The linear colour of red, green and blue from 0 to 1 and an alpha; white where one of them is no
/// finite number.
inline glm::vec4 linear_vertex_color(const glm::dvec3& srgb, double alpha = 1.0) {
    if (!std::isfinite(srgb.x + srgb.y + srgb.z + alpha)) return glm::vec4(1.0f);
    const auto linear = [](double x) { return linear_from_srgb(float(std::clamp(x, 0.0, 1.0))); };
    return {linear(srgb.x), linear(srgb.y), linear(srgb.z), float(std::clamp(alpha, 0.0, 1.0))};
}

} // namespace onde
