#include "scene/next_frame.h"

#include "scene/loaders.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace onde {
namespace {

/// The instances of each name, in their order. A file has the same list of names at any moment.
std::map<uint32_t, std::vector<size_t>> by_name(const Scene& scene) {
    std::map<uint32_t, std::vector<size_t>> all;
    for (size_t i = 0; i < scene.instances.size(); ++i) all[scene.instances[i].name].push_back(i);
    return all;
}

bool same_triangles(const Mesh& a, const Mesh& b) {
    return a.positions.size() == b.positions.size() && a.triangles == b.triangles;
}

} // namespace

std::vector<std::optional<size_t>> counterparts(const Scene& scene, const Scene& next) {
    std::vector<std::optional<size_t>> all(scene.instances.size());
    const auto theirs = by_name(next);
    for (const auto& [name, ours] : by_name(scene)) {
        const auto found = theirs.find(name);
        if (found == theirs.end() || found->second.size() != ours.size()) continue;
        for (size_t k = 0; k < ours.size(); ++k) {
            const size_t i = ours[k], j = found->second[k];
            if (same_triangles(scene.meshes[scene.instances[i].mesh],
                               next.meshes[next.instances[j].mesh]))
                all[i] = j;
        }
    }
    return all;
}

namespace {

/// How a mesh becomes another of the same triangles: all its vertices move by `shift`, which poses
/// far from 0 need double precision for, and each by a step of its own.
struct Deformation {
    glm::dvec3 shift{0.0};
    std::optional<uint32_t> steps{};
};

Deformation deformation(const Mesh& from, const Mesh& to, NextFrame& frame) {
    Deformation result;
    if (from.positions.empty() || from.positions == to.positions) return result;
    result.shift = glm::dvec3(to.positions[0]) - glm::dvec3(from.positions[0]);
    std::vector<glm::vec3> steps;
    for (size_t i = 0; i < from.positions.size(); ++i)
        steps.emplace_back(glm::dvec3(to.positions[i]) - result.shift -
                           glm::dvec3(from.positions[i]));
    const auto is_zero = [](const glm::vec3& step) { return step == glm::vec3(0.0f); };
    if (std::ranges::all_of(steps, is_zero)) return result;
    result.steps = uint32_t(frame.steps.size());
    frame.steps.push_back(std::move(steps));
    return result;
}

void note_lost(Scene& scene, size_t lost) {
    if (lost == 0) return;
    scene.notes.push_back(fmt::format(
        "The motion of {} of {} things is 0, as they come, go or change their triangles until the "
        "next frame.",
        lost, scene.instances.size()));
}

} // namespace

NextFrame standing_still(const Scene& scene) {
    NextFrame frame{.cameras = scene.cameras,
                    .instances = {},
                    .steps = {},
                    .environment_rotation = scene.environment.rotation};
    for (const Instance& instance : scene.instances)
        frame.instances.push_back({instance.object_to_world});
    return frame;
}

NextFrame next_frame(Scene& scene, const Scene& next) {
    NextFrame frame = standing_still(scene);
    if (next.cameras.size() == scene.cameras.size()) frame.cameras = next.cameras;
    std::map<std::pair<uint32_t, uint32_t>, Deformation> known;
    const std::vector<std::optional<size_t>> others = counterparts(scene, next);
    for (size_t i = 0; i < others.size(); ++i) {
        if (!others[i]) continue;
        const Instance& now = scene.instances[i];
        const Instance& then = next.instances[*others[i]];
        const auto [found, is_new] = known.try_emplace({now.mesh, then.mesh});
        if (is_new)
            found->second = deformation(scene.meshes[now.mesh], next.meshes[then.mesh], frame);
        const auto& [shift, steps] = found->second;
        glm::mat4 placed = then.object_to_world;
        if (shift != glm::dvec3(0.0)) placed = glm::mat4(glm::translate(glm::dmat4(placed), shift));
        frame.instances[i] = {placed, steps};
    }
    note_lost(scene, size_t(std::ranges::count(others, std::optional<size_t>())));
    return frame;
}

void load_next_frame(Scene& scene, const std::filesystem::path& path, LoadOptions options,
                     double seconds) {
    options.at = seconds;
    options.only_shapes = true;
    options.environment.reset();
    options.stage = Stage{.origin = scene.origin, .exponent = scene.exponent};
    scene.next = next_frame(scene, load_uncompleted(path, options));
}

} // namespace onde
