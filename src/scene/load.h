// From a file to a Scene. The front door of every loader.
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace onde {

/// Loads .gltf, .glb, .obj or .toml (by extension) and completes it: a scene without a camera is
/// framed, one without any light gets a neutral studio environment, and `notes` says so.
/// Every number is checked; the result satisfies check_scene(). Throws InputError with one sentence.
Scene load_scene(const std::filesystem::path& path);

/// Throws InputError unless every index is in range, every number finite, every range of scene.h
/// respected and there is something to see.
void check_scene(const Scene& scene);

/// Adds a camera that sees the whole scene if there is none, and an environment if nothing emits.
void complete_scene(Scene& scene);

/// World-space bounding box of all geometry; {0,0} for an empty scene.
struct SceneBounds {
    glm::vec3 low{0.0f}, high{0.0f};
};
SceneBounds scene_bounds(const Scene& scene);

/// A hash of everything that can change a pixel, stable from run to run, as 16 hex digits.
std::string scene_hash(const Scene& scene);

} // namespace onde
