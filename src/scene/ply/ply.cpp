// PLY, the Stanford triangle format. Header, values and mesh are read by ply_header, ply_body and
// ply_mesh; here they become a scene.
#include "core/error.h"
#include "scene/find_file.h"
#include "scene/loaders.h"
#include "scene/ply/mesh.h"
#include "scene/references.h"

#include <algorithm>

namespace onde {
namespace fs = std::filesystem;

/// Diffuse grey, or white times the colours of vertices and the picture that the header names.
static Material material_of(const ply::Header& header, const fs::path& path, Scene& scene,
                            Notes& notes, LoadContext& context) {
    Material material;
    material.name = "default";
    const std::vector<glm::vec4>& colors = scene.meshes[0].colors;
    if (!colors.empty()) material.base_color = glm::vec3(1.0f);
    if (std::ranges::any_of(colors, [](const glm::vec4& color) { return color.w < 1.0f; }))
        material.alpha_mode = AlphaMode::blend;
    if (header.texture.empty()) return material;
    FileFinder files(path.has_parent_path() ? path.parent_path() : fs::path("."), context);
    const auto found = files.find(header.texture);
    if (!found) {
        notes.wrong(files.may_use(header.texture)
                        ? "Textures that are missing are left out"
                        : "Textures outside of the scene's folder are not allowed and left out",
                    header.texture);
        return material;
    }
    try {
        material.base_color_texture =
            add_texture_file(scene, context, files.folder(), *found, {}, path.string());
        material.base_color = glm::vec3(1.0f);
    } catch (const OverBudget&) {
        throw;
    } catch (const InputError&) {
        notes.wrong("Textures that can't be read are left out", header.texture);
    }
    return material;
}

Scene load_ply(const fs::path& path, LoadContext& context) {
    const std::string file = read_file_within(context, path), name = path.string();
    const ply::Header header = ply::read_header(name, file);
    Notes notes = context.notes_of(path);
    Scene scene;
    place_only(ply::read_mesh(name, path.stem().string(), file, header, notes, context), scene);
    scene.materials.push_back(material_of(header, path, scene, notes, context));
    scene.notes = notes.sentences();
    return scene;
}

} // namespace onde
