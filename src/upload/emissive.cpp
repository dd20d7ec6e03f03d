#include "upload/emissive.h"

#include "upload/words.h"

#include <numbers>

namespace onde {

static LightRecord light_of(uint32_t kind, uint32_t material, uint32_t surface) {
    LightRecord record{};
    record.kind = kind;
    record.material = material;
    record.surface = surface;
    return record;
}

/// The area between two edges.
static double parallelogram(glm::vec3 edge1, glm::vec3 edge2) {
    return glm::length(glm::cross(edge1, edge2));
}

bool emits(const Material& material) {
    return material.emission.x > 0 || material.emission.y > 0 || material.emission.z > 0;
}

EmissivePrimitive emissive_triangle(uint32_t primitive, uint32_t material,
                                    const glm::vec3 corner[3], float orientation) {
    const glm::vec3 edge1 = corner[1] - corner[0], edge2 = corner[2] - corner[0];
    const double area = 0.5 * parallelogram(edge1, edge2);
    LightRecord light = light_of(LIGHT_TRIANGLE, material, primitive);
    copy(light.as.triangle.corner, corner[0]);
    copy(light.as.triangle.edge1, edge1);
    copy(light.as.triangle.edge2, edge2);
    light.as.triangle.area = float(area);
    light.as.triangle.orientation = orientation;
    return {primitive, material, light, area};
}

EmissivePrimitive emissive_sphere(uint32_t primitive, const Sphere& sphere) {
    LightRecord light = light_of(LIGHT_SPHERE, sphere.material, primitive);
    copy(light.as.sphere.center, sphere.center);
    light.as.sphere.radius = sphere.radius;
    const double area = 4 * std::numbers::pi * double(sphere.radius) * sphere.radius;
    return {primitive, sphere.material, light, area};
}

EmissivePrimitive emissive_shape(uint32_t primitive, const Shape& shape) {
    if (shape.kind != ShapeKind::disk) return {primitive, shape.material, std::nullopt, 0};
    // A disk's front is toward +Y, where cross(Z, X) points.
    const glm::mat4& m = shape.object_to_world;
    const glm::vec3 radius1(m[2]), radius2(m[0]);
    const double area = std::numbers::pi * parallelogram(radius1, radius2);
    LightRecord light = light_of(LIGHT_DISK, shape.material, primitive);
    copy(light.as.disk.center, glm::vec3(m[3]));
    copy(light.as.disk.radius1, radius1);
    copy(light.as.disk.radius2, radius2);
    light.as.disk.area = float(area);
    light.as.disk.orientation = glm::determinant(glm::mat3(m)) < 0 ? -1.0f : 1.0f;
    return {primitive, shape.material, light, area};
}

} // namespace onde
