// glTF 2.0 (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html) to a Scene.
#include "scene/gltf/animation.h"
#include "scene/gltf/scene.h"
#include "scene/loaders.h"

namespace onde {

Scene load_gltf(const std::filesystem::path& path, LoadContext& context) {
    gltf::File file = gltf::open_file(path, context);
    Scene scene;
    gltf::add_materials(file, scene);
    gltf::animate_nodes(file);
    gltf::add_nodes(file, scene);
    scene.notes = file.notes.sentences();
    return scene;
}

} // namespace onde
