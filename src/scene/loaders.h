// One loader per format. Each returns what the file says and nothing more: load.cpp completes and
// checks. Throw InputError with one sentence that names the file and the culprit.
#pragma once

#include "scene/load_context.h"
#include "scene/scene.h"

#include <filesystem>
#include <vector>

namespace onde {

Scene load_gltf(const std::filesystem::path& path, LoadContext& context); ///< .gltf and .glb
Scene load_obj(const std::filesystem::path& path, LoadContext& context);
Scene load_ply(const std::filesystem::path& path, LoadContext& context);
Scene load_stl(const std::filesystem::path& path, LoadContext& context);
Scene load_pbrt(const std::filesystem::path& path, LoadContext& context);
Scene load_mitsuba(const std::filesystem::path& path, LoadContext& context);

/// `ancestors` are the canonical paths of the scene files that include this one, outermost first.
Scene load_toml(const std::filesystem::path& path, LoadContext& context,
                const std::vector<std::filesystem::path>& ancestors = {});

/// The loader for the path's extension; the result is neither completed nor checked.
Scene load_part(const std::filesystem::path& path, LoadContext& context,
                const std::vector<std::filesystem::path>& ancestors = {});

/// Whether the file's format is one of things, and not of scenes that somebody has lit.
bool is_model(const std::filesystem::path& path);

/// A scene as load_scene() loads it, before complete_scene().
Scene load_uncompleted(const std::filesystem::path& path, const LoadOptions& options);

/// Takes infinite pixels of the environment as large finite ones, with a note.
void bound_environment(Scene& scene);

} // namespace onde
