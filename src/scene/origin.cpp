#include "scene/origin.h"

#include "scene/merge.h"
#include "scene/outline.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace onde {

static glm::dvec3 middle_of(const Extent& box) {
    return 0.5 * box.low + 0.5 * box.high;
}

static double half_diagonal(const Extent& box) {
    return 0.5 * glm::length(box.high - box.low);
}

Extent transformed(const Extent& box, const glm::dmat4& transform) {
    Extent result;
    if (box.empty()) return result;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point(corner & 1 ? box.high.x : box.low.x,
                               corner & 2 ? box.high.y : box.low.y,
                               corner & 4 ? box.high.z : box.low.z);
        result.grow(glm::dvec3(transform * glm::dvec4(point, 1.0)));
    }
    return result;
}

/// Of triangles that can be hit: exporters leave stray ones without area at 0.
template <class Positions>
static Extent extent_of_triangles(const Positions& positions,
                                  std::span<const glm::uvec3> triangles) {
    Extent extent;
    for (const glm::uvec3& triangle : triangles) {
        const glm::dvec3 a(positions[triangle.x]), b(positions[triangle.y]);
        const glm::dvec3 c(positions[triangle.z]);
        if (glm::cross(b - a, c - a) == glm::dvec3(0.0)) continue;
        for (const glm::dvec3& corner : {a, b, c}) extent.grow(corner);
    }
    return extent;
}

Extent extent_of(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles) {
    return extent_of_triangles(positions, triangles);
}

Extent extent_of(const Mesh& mesh) {
    return extent_of_triangles(mesh.positions, mesh.triangles);
}

void SceneExtent::add(const Extent& thing) {
    if (thing.empty()) return;
    all.grow(thing.low);
    all.grow(thing.high);
    if (half_diagonal(thing) > 0.0) smallest = std::min(smallest, half_diagonal(thing));
}

SceneExtent extent_of(const Scene& scene) {
    std::vector<Extent> boxes;
    for (const Mesh& mesh : scene.meshes) boxes.push_back(extent_of(mesh));
    SceneExtent extent;
    for (const Instance& instance : scene.instances)
        extent.add(transformed(boxes[instance.mesh], glm::dmat4(instance.object_to_world)));
    for (const Sphere& sphere : scene.spheres) {
        const glm::dvec3 center(sphere.center);
        extent.add({center - double(sphere.radius), center + double(sphere.radius)});
    }
    for (const Shape& shape : scene.shapes) {
        const SceneBounds box = canonical_box(shape);
        extent.add(transformed({glm::dvec3(box.low), glm::dvec3(box.high)},
                               glm::dmat4(shape.object_to_world)));
    }
    return extent;
}

glm::dvec3 origin_of(const SceneExtent& scene) {
    if (scene.all.empty()) return glm::dvec3(0.0);
    const bool has_details = glm::length(middle_of(scene.all)) > FAR_DETAIL * scene.smallest;
    return origin_of(scene.all, has_details ? FAR_GROUND : FAR_SCENE);
}

void count_from(const glm::dvec3& origin, Scene& scene) {
    if (scene.origin == origin) return;
    const glm::vec3 step(scene.origin - origin);
    place_anew(scene, glm::translate(glm::mat4(1.0f), step));
    if (scene.environment.ground) *scene.environment.ground += step.y;
    scene.origin = origin;
}

glm::dvec3 origin_of(const Extent& box, double far) {
    if (box.empty()) return glm::dvec3(0.0);
    const glm::dvec3 middle = middle_of(box);
    const double size = half_diagonal(box), distance = glm::length(middle);
    if (!(distance > far * size) || !std::isfinite(distance)) return glm::dvec3(0.0);
    if (size == 0.0) return middle;
    const double step = std::exp2(std::ceil(std::log2(size)));
    return glm::round(middle / step) * step;
}

glm::vec3 rounded(const glm::dvec3& position) {
    return glm::vec3(position);
}

std::vector<glm::vec3> counted_from(const glm::dvec3& origin,
                                    std::span<const glm::dvec3> positions) {
    std::vector<glm::vec3> result;
    result.reserve(positions.size());
    for (const glm::dvec3& position : positions) result.emplace_back(position - origin);
    return result;
}

} // namespace onde
