// Meshes that a scene file names, for the readers of other renderers' scenes.
#pragma once

#include "scene/load_context.h"
#include "scene/scene.h"

#include <filesystem>

namespace onde {

/// The surface of an .obj, .ply or .stl alone: one mesh without a material of its own. Its notes
/// are in it. Throws InputError as the format's reader does, and for other formats.
struct MeshFile {
    Mesh mesh;
    glm::dvec3 origin{0.0}; ///< from which its positions are counted
    std::vector<std::string> notes;
};
MeshFile load_mesh_file(const std::filesystem::path& path, LoadContext& context);

} // namespace onde
