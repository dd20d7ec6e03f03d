// What bounds some lights: where they are, where they look, how strong they are.
#pragma once

#include "shared/scene.h"

#include <glm/glm.hpp>

namespace onde {

struct LightBounds {
    glm::dvec3 low{0.0}, high{0.0};
    glm::dvec3 axis{0, 0, 1}; ///< unit
    double spread = 0;        ///< of their normals about the axis, radians up to pi
    double reach = 0;         ///< beyond their normals they send nothing, radians
    double power = 0;
};

/// What bounds both.
LightBounds joined(const LightBounds& a, const LightBounds& b);

/// Of a light that has a place.
LightBounds bounds_of(const LightRecord& light, bool two_sided, double power);

} // namespace onde
