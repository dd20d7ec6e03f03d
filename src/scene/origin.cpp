#include "scene/origin.h"

#include "scene/merge.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace onde {

void SceneExtent::add(const Extent& thing) {
    if (thing.empty()) return;
    all.grow(thing.low);
    all.grow(thing.high);
    if (half_diagonal(thing) > 0.0) smallest = std::min(smallest, half_diagonal(thing));
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

SceneExtent scene_extent_of(std::span<const glm::dvec3> positions,
                            std::span<const glm::uvec3> triangles) {
    SceneExtent extent;
    extent.all = extent_of(positions, triangles);
    extent.details = details_of(positions, triangles, MOST_DETAILS);
    return extent;
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
