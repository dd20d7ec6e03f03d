// Wavefront OBJ with its MTL files: read, repaired, given materials, made a mesh.
#include "core/error.h"
#include "scene/loaders.h"
#include "scene/obj/library.h"
#include "scene/obj/material.h"
#include "scene/obj/mesh.h"
#include "scene/obj/repair.h"
#include "scene/text.h"

#include <algorithm>

namespace onde {
namespace fs = std::filesystem;

namespace {

/// What the names of a file's materials stand for.
struct Bindings {
    std::vector<uint32_t> materials;   ///< of the scene, by File::material_names
    std::vector<obj::UvMove> uv_moves; ///< by the same
};

/// Grey, or white where vertices have colours.
Material default_material(const obj::File& file) {
    Material material;
    material.name = "default";
    if (!file.colors.empty()) material.base_color = glm::vec3(1.0f);
    return material;
}

/// Some programs write colours from 0 to 255.
void scale_colors(obj::File& file) {
    const auto exceeds_1 = [](const glm::vec3& c) {
        return c.x > 1.0f || c.y > 1.0f || c.z > 1.0f;
    };
    if (!std::ranges::any_of(file.colors, exceeds_1)) return;
    for (glm::vec3& color : file.colors) color /= 255.0f;
}

/// Converts the materials that faces use.
Bindings bind_materials(const obj::File& file, const obj::Libraries& libraries, Scene& scene,
                        FileFinder& files, Notes& notes) {
    Bindings bindings{std::vector<uint32_t>(file.material_names.size(), 0),
                      std::vector<obj::UvMove>(file.material_names.size())};
    std::vector<char> used(file.material_names.size(), 0);
    for (const obj::Face& face : file.faces) used[face.material] = 1;
    std::map<const mtl::Material*, uint32_t> converted;
    for (size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        const obj::LibraryMaterial* found = libraries.find(file.material_names[i]);
        const mtl::Material* source = found ? &found->material : nullptr;
        if (!found && !file.material_names[i].empty())
            notes.wrong("Materials that no MTL file has are diffuse grey", file.material_names[i]);
        const auto [known, is_new] = converted.try_emplace(source, scene.materials.size());
        bindings.materials[i] = known->second;
        if (source) bindings.uv_moves[i] = {source->diffuse_map.scale, source->diffuse_map.offset};
        if (!is_new) continue;
        if (found)
            scene.materials.push_back(convert_mtl(*source, scene, files, found->folder, notes));
        else
            scene.materials.push_back(default_material(file));
    }
    return bindings;
}

} // namespace

Scene load_obj(const fs::path& path, LoadContext& context) {
    const std::string name = path.string();
    const auto text = text::decode(read_file_within(context, path));
    if (!text) throw InputError("{}: not a text file; an OBJ must be ASCII or UTF-8", name);
    Notes notes = context.notes_of(path);
    Scene scene;
    GradualSpending cost(context, name);
    obj::File file = obj::read(name, *text, notes, cost);
    FileFinder files(path.has_parent_path() ? path.parent_path() : fs::path("."), context);
    const obj::Libraries libraries(file.libraries, files, notes);
    const Bindings bindings = bind_materials(file, libraries, scene, files, notes);
    obj::move_uvs(file, bindings.uv_moves);
    scale_colors(file);
    const bool empty = file.faces.empty();
    obj::drop_bad_numbers(file, notes);
    if (file.faces.empty() && !empty)
        throw InputError("{}: all faces have positions that are no finite numbers; export it again",
                         name);
    obj::smooth_groups(file);
    place_only(obj::build_mesh(file, path.stem().string(), bindings.materials, notes, cost), scene);
    scene.notes = notes.sentences();
    return scene;
}

} // namespace onde
