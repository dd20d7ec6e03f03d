// From a file to a Scene. The front door of every loader.
#pragma once

#include "scene/load_options.h"
#include "scene/scene.h"

#include <filesystem>

namespace onde {

/// Loads .gltf, .glb, .obj, .ply, .stl or .toml (by extension) and completes it: a scene without a
/// camera is framed, one without any light gets a neutral studio environment, and `notes` says so.
/// Every number is checked; the result satisfies check_scene(). `environment` replaces the file's
/// own before that. Throws InputError with one sentence.
Scene load_scene(const std::filesystem::path& path,
                 const std::optional<Environment>& environment = {},
                 const LoadOptions& options = {});

/// Throws InputError unless every index is in range, every number finite, every range of scene.h
/// respected and there is something to see.
void check_scene(const Scene& scene);

/// Adds a camera that sees the whole scene if there is none, and a studio environment if nothing
/// emits but, at most, small details in emission textures; completes the measures of lights.
/// Indices must be in range.
void complete_scene(Scene& scene);

/// World-space bounding box of all geometry; {0,0} for an empty scene.
struct SceneBounds {
    glm::vec3 low{0.0f}, high{0.0f};
};
SceneBounds scene_bounds(const Scene& scene);

/// An environment from an equirectangular picture: its pixels times `scale`, turned about +Y.
/// Pixels that are negative or not finite become 0. Throws InputError as read_image does.
Environment load_environment(const std::filesystem::path& path, glm::vec3 scale,
                             float rotation_degrees);

/// A hash of everything in the scene that can change a pixel, stable from run to run, as 16 hex
/// digits. Names, notes and the settings, which the command line overrides, are left out.
std::string scene_hash(const Scene& scene);

} // namespace onde
