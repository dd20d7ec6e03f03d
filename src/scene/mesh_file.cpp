#include "scene/mesh_file.h"

#include "core/error.h"
#include "core/files.h"
#include "scene/loaders.h"

namespace onde {

MeshFile load_mesh_file(const std::filesystem::path& path, LoadContext& context) {
    const std::string extension = lower_extension(path);
    if (extension != ".obj" && extension != ".ply" && extension != ".stl")
        throw InputError("{}: is no mesh that a scene may name; give a .obj, .ply or .stl",
                         path.string());
    Scene scene = load_part(path, context);
    return {std::move(scene.meshes.at(0)), scene.origin, std::move(scene.notes)};
}

} // namespace onde
