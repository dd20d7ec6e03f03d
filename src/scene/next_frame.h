// Where things are at the next frame of an animation: what motion vectors lead to.
#pragma once

#include "scene/camera.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace onde {

struct Scene;
struct LoadOptions;

/// An instance of a scene, a frame later.
struct NextInstance {
    glm::mat4 object_to_world{1.0f};
    /// Index of the steps that the vertices of its mesh take in their own space; without, none.
    std::optional<uint32_t> steps{};
};

/// A scene's things, a frame later; all else is as it was.
struct NextFrame {
    std::vector<Camera> cameras;               ///< as many as the scene has
    std::vector<NextInstance> instances;       ///< likewise
    std::vector<std::vector<glm::vec3>> steps; ///< each of all vertices of a mesh
    float environment_rotation = 0.0f;         ///< of its map
};

/// For each instance of a scene, that of `next`, of the same file, which it becomes: things belong
/// together as next_frame() says.
std::vector<std::optional<size_t>> counterparts(const Scene& scene, const Scene& next);

/// That of a scene in which nothing moves.
NextFrame standing_still(const Scene& scene);

/// That of a scene which `next`, of the same file, shows a frame later, counted from the same
/// origin. Things belong together by their places in the list of names and, where several have one,
/// by their order. What has no counterpart of the same triangles stands still, of which the scene
/// gets a note.
NextFrame next_frame(Scene& scene, const Scene& next);

/// Gives a scene, which load_scene() has loaded from there with these options, the next frame that
/// the file has at `seconds` of its animation. Throws InputError as load_scene() does.
void load_next_frame(Scene& scene, const std::filesystem::path& path, LoadOptions options,
                     double seconds);

/// A hash of all of it, as scene_hash().
std::string next_frame_hash(const NextFrame& next);

} // namespace onde
