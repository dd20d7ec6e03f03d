// From a file to a Scene. The front door of every loader.
#pragma once

#include "image/image_io.h"
#include "scene/load_options.h"
#include "scene/scene.h"

#include <filesystem>
#include <string_view>

namespace onde {

/// The files that load_scene() takes, for sentences.
inline constexpr std::string_view SCENE_FILES =
    ".gltf, .glb, .obj, .ply, .stl, .pbrt, .xml (Mitsuba 3) or .toml";

/// Loads one of SCENE_FILES, by its extension, and completes it as complete_scene() does. Every
/// number is checked; the result satisfies check_scene(). Throws InputError with one sentence.
Scene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// Throws InputError unless every index is in range, every number finite, every range of scene.h
/// respected and there is something to see.
void check_scene(const Scene& scene);

/// Adds a camera that frames the whole scene if there is none, and the studio where it is asked
/// for, with a note of either; completes the measures of lights. `is_model`: what stands in the
/// file is things, not a scene that somebody has lit. Indices must be in range.
void complete_scene(Scene& scene, const LoadOptions& options = {}, bool is_model = false);

/// World-space bounding box of all geometry; {0,0} for an empty scene.
struct SceneBounds {
    glm::vec3 low{0.0f}, high{0.0f};
};
SceneBounds scene_bounds(const Scene& scene);

/// An environment from an equirectangular picture: its pixels times `scale`, turned about +Y.
/// Pixels that are negative or no numbers become 0; infinite ones stay, load_scene bounds them.
/// Throws InputError as read_image does.
Environment load_environment(const std::filesystem::path& path, glm::vec3 scale,
                             float rotation_degrees, uint64_t max_pixels = MOST_PIXELS);

class LoadContext;
/// The same within what a load may take, which it spends: throws OverBudget before it decodes.
Environment load_environment_within(LoadContext& context, const std::filesystem::path& path,
                                    float rotation_degrees);

/// What a pixel of an environment takes: read and made a radiance, or packed with its weights.
inline constexpr uint64_t ENVIRONMENT_PIXEL_BYTES = 48;

/// A hash of everything in the scene that can change a pixel, stable from run to run, as 16 hex
/// digits. Names, notes and the settings, which the command line overrides, are left out.
std::string scene_hash(const Scene& scene);

} // namespace onde
