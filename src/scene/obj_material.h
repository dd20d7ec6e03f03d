// MTL materials to ours.
#pragma once

#include "scene/notes.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace tinyobj {
struct material_t;
}

namespace onde {

/// The material and the textures it uses, which are added to `scene`. A texture that is missing or
/// outside of `folder` is an InputError that begins with `where`.
Material convert_mtl(const tinyobj::material_t& source, Scene& scene,
                     const std::filesystem::path& folder, const std::string& where, Notes& notes);

} // namespace onde
