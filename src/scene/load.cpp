#include "scene/load.h"

#include "core/error.h"
#include "core/files.h"
#include "core/shown.h"
#include "scene/loaders.h"
#include "scene/scale.h"

namespace onde {
namespace fs = std::filesystem;

Scene load_part(const fs::path& path, LoadContext& context,
                const std::vector<fs::path>& ancestors) {
    const std::string extension = lower_extension(path);
    if (extension == ".gltf" || extension == ".glb") return load_gltf(path, context);
    if (extension == ".obj") return load_obj(path, context);
    if (extension == ".ply") return load_ply(path, context);
    if (extension == ".stl") return load_stl(path, context);
    if (extension == ".toml") return load_toml(path, context, ancestors);
    throw InputError(
        "{}: '{}' is not a scene format of ours; give a .gltf, .glb, .obj, .ply, .stl or .toml",
        path.string(), shown(extension));
}

Scene load_scene(const fs::path& path, const LoadOptions& options) {
    LoadContext context(options);
    Scene scene = load_part(path, context);
    if (options.environment) scene.environment = *options.environment;
    bound_environment(scene);
    try {
        check_scene(scene);
        bring_to_scale(scene);
        complete_scene(scene, options, lower_extension(path) != ".toml");
        check_scene(scene); // a framing camera of a scene near the end of float's range
    } catch (const InputError& error) {
        throw InputError("{}: {}", path.string(), error.what());
    }
    return scene;
}

} // namespace onde
