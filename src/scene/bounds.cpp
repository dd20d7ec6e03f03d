#include "scene/load.h"
#include "scene/outline.h"

#include <limits>

namespace onde {

/// The box around a transformed box (Arvo, "Transforming axis-aligned bounding boxes", 1990).
static SceneBounds transformed(const SceneBounds& box, const glm::mat4& m) {
    SceneBounds result{glm::vec3(m[3]), glm::vec3(m[3])};
    for (size_t axis = 0; axis < 3; ++axis) {
        const glm::vec3 a = glm::vec3(m[axis]) * box.low[axis];
        const glm::vec3 b = glm::vec3(m[axis]) * box.high[axis];
        result.low += glm::min(a, b);
        result.high += glm::max(a, b);
    }
    return result;
}

SceneBounds scene_bounds(const Scene& scene) {
    constexpr float INF = std::numeric_limits<float>::infinity();
    SceneBounds bounds{glm::vec3(INF), glm::vec3(-INF)};
    const auto grow = [&](const glm::vec3& low, const glm::vec3& high) {
        bounds.low = glm::min(bounds.low, low);
        bounds.high = glm::max(bounds.high, high);
    };
    visit_meshes(scene, [&](glm::vec3 point) { grow(point, point); });
    for (const Sphere& sphere : scene.spheres)
        grow(sphere.center - sphere.radius, sphere.center + sphere.radius);
    for (const Shape& shape : scene.shapes) {
        const SceneBounds box = transformed(canonical_box(shape), shape.object_to_world);
        grow(box.low, box.high);
    }
    return bounds.low.x <= bounds.high.x ? bounds : SceneBounds{};
}

} // namespace onde
