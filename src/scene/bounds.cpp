#include "scene/load.h"

#include <limits>

namespace onde {

static void grow(SceneBounds& bounds, const glm::vec3& low, const glm::vec3& high) {
    bounds.low = glm::min(bounds.low, low);
    bounds.high = glm::max(bounds.high, high);
}

/// Of the transformed vertices, not of the transformed box: rotated instances stay tight.
static void grow(SceneBounds& bounds, const Mesh& mesh, const glm::mat4& object_to_world) {
    for (const glm::uvec3& triangle : mesh.triangles)
        for (size_t corner = 0; corner < 3; ++corner) {
            const glm::vec4 position(mesh.positions[triangle[corner]], 1.0f);
            const glm::vec3 point(object_to_world * position);
            grow(bounds, point, point);
        }
}

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

static SceneBounds canonical_box(const Shape& shape) {
    const float r = shape.kind == ShapeKind::torus ? shape.minor_radius : 0.0f;
    switch (shape.kind) {
    case ShapeKind::disk:
    case ShapeKind::cone:
        return {glm::vec3(-1, 0, -1), glm::vec3(1, shape.kind == ShapeKind::cone, 1)};
    case ShapeKind::torus:
        return {glm::vec3(-1 - r, -r, -1 - r), glm::vec3(1 + r, r, 1 + r)};
    default:
        return {glm::vec3(-1), glm::vec3(1)};
    }
}

SceneBounds scene_bounds(const Scene& scene) {
    constexpr float INF = std::numeric_limits<float>::infinity();
    const SceneBounds nothing{glm::vec3(INF), glm::vec3(-INF)};
    SceneBounds bounds = nothing;
    std::vector<uint32_t> uses(scene.meshes.size(), 0);
    for (const Instance& instance : scene.instances) ++uses[instance.mesh];
    // Exact where a mesh is placed once; by its box where it is placed often, for speed.
    std::vector<SceneBounds> boxes(scene.meshes.size(), nothing);
    for (size_t i = 0; i < scene.meshes.size(); ++i)
        if (uses[i] > 1) grow(boxes[i], scene.meshes[i], glm::mat4(1.0f));
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (mesh.triangles.empty()) continue;
        if (uses[instance.mesh] == 1) {
            grow(bounds, mesh, instance.object_to_world);
        } else {
            const SceneBounds box = transformed(boxes[instance.mesh], instance.object_to_world);
            grow(bounds, box.low, box.high);
        }
    }
    for (const Sphere& sphere : scene.spheres)
        grow(bounds, sphere.center - sphere.radius, sphere.center + sphere.radius);
    for (const Shape& shape : scene.shapes) {
        const SceneBounds box = transformed(canonical_box(shape), shape.object_to_world);
        grow(bounds, box.low, box.high);
    }
    return bounds.low.x <= bounds.high.x ? bounds : SceneBounds{};
}

} // namespace onde
