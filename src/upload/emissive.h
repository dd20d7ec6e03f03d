// Primitives that emit light, as records of the lights that they are.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

#include <optional>

namespace onde {

/// A primitive that emits light, in world space.
struct EmissivePrimitive {
    uint32_t primitive = 0; ///< its SurfaceRecord
    uint32_t material = 0;
    /// Without probabilities; none for shapes whose light only rays find.
    std::optional<LightRecord> light;
    double area = 0; ///< of the face that emits, or of each of two
};

/// Whether a surface of that material emits at all.
bool emits(const Material& material);

/// orientation: -1 when the front face looks against cross(corner 1 - 0, corner 2 - 0).
EmissivePrimitive emissive_triangle(uint32_t primitive, uint32_t material,
                                    const glm::vec3 corner[3], float orientation);
EmissivePrimitive emissive_sphere(uint32_t primitive, const Sphere& sphere);
EmissivePrimitive emissive_shape(uint32_t primitive, const Shape& shape);

} // namespace onde
