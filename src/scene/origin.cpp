#include "scene/origin.h"

#include "scene/merge.h"
#include "scene/outline.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

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

template <class Positions>
static std::vector<Detail> details_of_triangles(const Positions& positions,
                                                std::span<const glm::uvec3> triangles,
                                                size_t most) {
    std::vector<Detail> details;
    const size_t step = triangles.size() / std::max<size_t>(most, 1) + 1;
    for (size_t i = 0; i < triangles.size(); i += step) {
        Extent box;
        for (const uint32_t v : {triangles[i].x, triangles[i].y, triangles[i].z})
            box.grow(glm::dvec3(positions[v]));
        const Detail detail{middle_of(box), half_diagonal(box), double(step)};
        if (detail.size > 0.0 && std::isfinite(detail.size)) details.push_back(detail);
    }
    return details;
}

std::vector<Detail> details_of(std::span<const glm::dvec3> positions,
                               std::span<const glm::uvec3> triangles, size_t most) {
    return details_of_triangles(positions, triangles, most);
}

std::vector<Detail> details_of(const Mesh& mesh, size_t most) {
    return details_of_triangles(mesh.positions, mesh.triangles, most);
}

Detail transformed(const Detail& detail, const glm::dmat4& transform) {
    double scale = 0.0;
    for (glm::length_t k = 0; k < 3; ++k)
        scale = std::max(scale, glm::length(glm::dvec3(transform[k])));
    return {glm::dvec3(transform * glm::dvec4(detail.middle, 1.0)), scale * detail.size,
            detail.weight};
}

void SceneExtent::add(const Extent& thing) {
    if (thing.empty()) return;
    all.grow(thing.low);
    all.grow(thing.high);
    if (half_diagonal(thing) > 0.0) smallest = std::min(smallest, half_diagonal(thing));
}

size_t most_details(size_t instances) {
    constexpr size_t MOST_DETAILS = 4096, MOST_OF_MESH = 64;
    return std::min(MOST_DETAILS / (instances + 1) + 1, MOST_OF_MESH);
}

static Extent extent_of(const Sphere& sphere) {
    const glm::dvec3 center(sphere.center);
    return {center - double(sphere.radius), center + double(sphere.radius)};
}

static Extent extent_of(const Shape& shape) {
    const SceneBounds box = canonical_box(shape);
    return transformed({glm::dvec3(box.low), glm::dvec3(box.high)},
                       glm::dmat4(shape.object_to_world));
}

std::vector<Detail> details_of(const Scene& scene) {
    std::vector<std::vector<Detail>> of_meshes;
    for (const Mesh& mesh : scene.meshes)
        of_meshes.push_back(details_of(mesh, most_details(scene.instances.size())));
    std::vector<Detail> details;
    for (const Instance& instance : scene.instances)
        for (const Detail& detail : of_meshes[instance.mesh])
            details.push_back(transformed(detail, glm::dmat4(instance.object_to_world)));
    const auto add = [&](const Extent& box) {
        details.push_back({middle_of(box), half_diagonal(box)});
    };
    for (const Sphere& sphere : scene.spheres) add(extent_of(sphere));
    for (const Shape& shape : scene.shapes) add(extent_of(shape));
    return details;
}

static void add_views(SceneExtent& extent, const std::vector<Camera>& cameras) {
    constexpr double PARTS = 128.0; // of the way to it that are details: some ten pixels
    double weight = 0.0;
    for (const Detail& detail : extent.details) weight += detail.weight;
    for (const Camera& camera : cameras) {
        const glm::dmat4 m(camera.camera_to_world);
        const double way = camera.focus_distance;
        const double seen = camera.orthographic_height.value_or(camera.focus_distance);
        extent.details.push_back({glm::dvec3(m[3]) - way * glm::dvec3(m[2]), seen / PARTS,
                                  weight / double(cameras.size())});
    }
}

SceneExtent extent_of(const Scene& scene) {
    std::vector<Extent> boxes;
    for (const Mesh& mesh : scene.meshes) boxes.push_back(extent_of(mesh));
    SceneExtent extent;
    for (const Instance& instance : scene.instances)
        extent.add(transformed(boxes[instance.mesh], glm::dmat4(instance.object_to_world)));
    for (const Sphere& sphere : scene.spheres) extent.add(extent_of(sphere));
    for (const Shape& shape : scene.shapes) extent.add(extent_of(shape));
    extent.details = details_of(scene);
    add_views(extent, scene.cameras);
    return extent;
}

SceneExtent extent_of_scene(std::span<const glm::dvec3> positions,
                            std::span<const glm::uvec3> triangles) {
    constexpr size_t MOST_DETAILS = 4096;
    SceneExtent extent;
    extent.all = extent_of(positions, triangles);
    extent.details = details_of(positions, triangles, MOST_DETAILS);
    return extent;
}

/// The bits that a detail lacks where positions are counted from there.
static double lost_bits(const Detail& detail, const glm::dvec3& origin) {
    const double times = glm::length(detail.middle - origin) / detail.size;
    return times > FAR_FOR_SIZE ? detail.weight * std::log2(times / FAR_FOR_SIZE) : 0.0;
}

static double lost_bits(std::span<const Detail> details, const glm::dvec3& origin) {
    double sum = 0.0;
    for (const Detail& detail : details) sum += lost_bits(detail, origin);
    return sum;
}

/// A point near a detail, in steps that subtract without rounding.
static glm::dvec3 origin_near(const Detail& detail) {
    const double step = std::exp2(std::ceil(std::log2(detail.size)));
    return glm::round(detail.middle / step) * step;
}

/// The origin that keeps the most bits of the details: this one, unless another loses less than
/// ENOUGH of what is lost here.
static glm::dvec3 better_origin(std::span<const Detail> details, const glm::dvec3& origin) {
    constexpr size_t MOST_COMPARED = 1024, MOST_CANDIDATES = 32;
    constexpr double ENOUGH = 0.75;
    const double lost = lost_bits(details, origin);
    if (!(lost > 0.0)) return origin;
    const size_t step = details.size() / MOST_COMPARED + 1;
    std::vector<Detail> compared;
    for (size_t i = details.size(); i-- > 0;) // the cameras' too, which are the last
        if ((details.size() - 1 - i) % step == 0) compared.push_back(details[i]);
    std::vector<Detail> worst(details.begin(), details.end());
    std::ranges::stable_sort(worst, std::ranges::greater(),
                             [&](const Detail& detail) { return lost_bits(detail, origin); });
    worst.resize(std::min(worst.size(), MOST_CANDIDATES));
    glm::dvec3 best = origin;
    double least = ENOUGH * lost_bits(compared, origin);
    for (const Detail& candidate : worst) {
        const double now = lost_bits(compared, origin_near(candidate));
        if (now >= least) continue;
        least = now;
        best = origin_near(candidate);
    }
    return best;
}

glm::dvec3 origin_of(const SceneExtent& scene) {
    if (scene.all.empty()) return glm::dvec3(0.0);
    const bool has_details = glm::length(middle_of(scene.all)) > FAR_DETAIL * scene.smallest;
    return better_origin(scene.details, origin_of(scene.all, has_details ? FAR_GROUND : FAR_SCENE));
}

Detail torn_detail(std::span<const Detail> details) {
    Detail torn{glm::dvec3(0.0), 0.0, 0.0};
    double all = 0.0, most = 0.0, weight = 0.0;
    for (const Detail& detail : details) {
        all += detail.weight;
        const double times = glm::length(detail.middle) / detail.size;
        if (!(times > FAR_FOR_SIZE)) continue;
        weight += detail.weight;
        if (times > most) torn = detail;
        most = std::max(most, times);
    }
    torn.weight = all > 0.0 ? weight / all : 0.0;
    return torn;
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
