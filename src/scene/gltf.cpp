// glTF 2.0 (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html) to a Scene.
#include "scene/gltf_scene.h"
#include "scene/loaders.h"

namespace onde {

Scene load_gltf(const std::filesystem::path& path) {
    gltf::File file = gltf::open_file(path);
    Scene scene;
    gltf::add_materials(file, scene);
    gltf::add_meshes(file, scene);
    gltf::add_nodes(file, scene);
    if (!file.model.animations.empty()) file.notes.add("Animations are ignored: the rest pose");
    if (!file.model.skins.empty()) file.notes.add("Skins are ignored: the rest pose");
    scene.notes = file.notes.sentences();
    return scene;
}

} // namespace onde
