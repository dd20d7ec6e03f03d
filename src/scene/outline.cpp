#include "scene/outline.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace onde {
namespace {

glm::vec3 placed(const glm::mat4& transform, glm::vec3 point) {
    return glm::vec3(transform * glm::vec4(point, 1.0f));
}

void visit_corners(const SceneBounds& box, const glm::mat4& transform, const VisitPoint& visit) {
    for (int corner = 0; corner < 8; ++corner)
        visit(placed(transform,
                     {corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                      corner & 4 ? box.high.z : box.low.z}));
}

void visit_mesh(const Mesh& mesh, const glm::mat4& transform, const VisitPoint& visit) {
    for (const glm::uvec3& triangle : mesh.triangles)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            visit(placed(transform, mesh.positions[triangle[corner]]));
}

SceneBounds box_of(const Mesh& mesh) {
    constexpr float INF = std::numeric_limits<float>::infinity();
    SceneBounds box{glm::vec3(INF), glm::vec3(-INF)};
    visit_mesh(mesh, glm::mat4(1.0f), [&](glm::vec3 point) {
        box.low = glm::min(box.low, point);
        box.high = glm::max(box.high, point);
    });
    return box;
}

/// Points of the unit sphere about the origin, by circles of latitude.
void visit_sphere(const glm::mat4& transform, const VisitPoint& visit) {
    constexpr int CIRCLES = 32, POINTS = 64;
    constexpr float PI = std::numbers::pi_v<float>;
    for (int circle = 0; circle <= CIRCLES; ++circle) {
        const float polar = PI * float(circle) / CIRCLES;
        for (int k = 0; k < POINTS; ++k) {
            const float turn = 2 * PI * float(k) / POINTS;
            visit(placed(transform, {std::sin(polar) * std::cos(turn), std::cos(polar),
                                     std::sin(polar) * std::sin(turn)}));
        }
    }
}

} // namespace

SceneBounds canonical_box(const Shape& shape) {
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

void visit_meshes(const Scene& scene, const VisitPoint& visit) {
    std::vector<uint32_t> uses(scene.meshes.size(), 0);
    for (const Instance& instance : scene.instances) ++uses[instance.mesh];
    std::vector<SceneBounds> boxes(scene.meshes.size());
    for (size_t i = 0; i < scene.meshes.size(); ++i)
        if (uses[i] > 1) boxes[i] = box_of(scene.meshes[i]);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (mesh.triangles.empty()) continue;
        if (uses[instance.mesh] == 1)
            visit_mesh(mesh, instance.object_to_world, visit);
        else
            visit_corners(boxes[instance.mesh], instance.object_to_world, visit);
    }
}

void visit_outline(const Scene& scene, const VisitPoint& visit) {
    visit_meshes(scene, visit);
    for (const Sphere& sphere : scene.spheres) {
        glm::mat4 transform(sphere.radius);
        transform[3] = glm::vec4(sphere.center, 1.0f);
        visit_sphere(transform, visit);
    }
    for (const Shape& shape : scene.shapes)
        if (shape.kind == ShapeKind::sphere)
            visit_sphere(shape.object_to_world, visit);
        else
            visit_corners(canonical_box(shape), shape.object_to_world, visit);
}

} // namespace onde
