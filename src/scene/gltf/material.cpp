// Materials of glTF (section 3.9).
#include "core/shown.h"
#include "scene/gltf/material_extensions.h"
#include "scene/gltf/numbers.h"
#include "scene/gltf/old_materials.h"
#include "scene/gltf/reachable.h"
#include "scene/gltf/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace onde::gltf {

namespace {

void apply_metallic_roughness(TextureLoader& textures, const JsonReader& source,
                              const std::string& user, Material& material) {
    const std::optional<JsonReader> pbr = source.object("pbrMetallicRoughness");
    material.base_color = glm::vec3(1.0f);
    if (pbr)
        if (const auto factor = pbr->vector<4>("baseColorFactor")) {
            material.base_color = glm::clamp(rgb(*factor), 0.0f, 1.0f);
            material.alpha = unit((*factor)[3]);
        }
    material.metallic = unit(number_in(pbr, "metallicFactor", 1.0));
    material.roughness = unit(number_in(pbr, "roughnessFactor", 1.0));
    material.base_color_texture = textures.load(pbr, "baseColorTexture", true, user);
    material.metallic_roughness_texture =
        textures.load(pbr, "metallicRoughnessTexture", false, user);
}

void apply_alpha(File& file, const JsonReader& source, const std::string& user,
                 Material& material) {
    const std::string mode = source.text("alphaMode").value_or("OPAQUE");
    if (mode == "MASK")
        material.alpha_mode = AlphaMode::mask;
    else if (mode == "BLEND")
        material.alpha_mode = AlphaMode::blend;
    else if (mode != "OPAQUE")
        file.notes.wrong("Unknown alpha modes are taken as OPAQUE", user);
    material.alpha_cutoff = float(std::max(0.0, source.number("alphaCutoff", 0.5)));
}

Material convert(File& file, TextureLoader& textures, OldMaterials& old_materials,
                 const JsonReader& source, const std::string& user) {
    Material material;
    material.name = shown(source.text("name").value_or(""));
    material.kind = MaterialKind::metallic_roughness;
    apply_metallic_roughness(textures, source, user, material);
    old_materials.apply(source, user, material);
    material.emission = glm::vec3(0.0f);
    if (const auto factor = source.vector<3>("emissiveFactor"))
        material.emission = glm::max(rgb(*factor), 0.0f);
    material.two_sided = material.double_sided = source.boolean("doubleSided", false);
    material.emission_texture = textures.load(source, "emissiveTexture", true, user);
    material.normal_scale = float(number_in(source.object("normalTexture"), "scale", 1.0));
    material.normal_texture = textures.load(source, "normalTexture", false, user);
    apply_alpha(file, source, user, material);
    if (source.extension("KHR_materials_unlit")) {
        material.kind = MaterialKind::unlit;
        material.emission = glm::vec3(0.0f);
        return material;
    }
    apply_extensions(textures, source, user, material);
    return material;
}

} // namespace

void add_materials(File& file, Scene& scene) {
    TextureLoader textures(file, scene);
    OldMaterials old_materials(file, scene, textures);
    const std::vector<JsonReader>& materials = file.document.materials;
    const std::vector<bool> used = shown_materials(file);
    for (size_t i = 0; i < materials.size(); ++i) {
        const std::string name = materials[i].text("name").value_or("");
        textures.is_shown = used[i] && !file.context.options().only_shapes;
        const std::string user = name.empty() ? fmt::format("material {}", i)
                                              : fmt::format("material {} '{}'", i, shown(name));
        scene.materials.push_back(convert(file, textures, old_materials, materials[i], user));
    }
    old_materials.release_textures();
    Material& none = scene.materials.emplace_back();
    none.name = "default";
    none.kind = MaterialKind::metallic_roughness;
    none.base_color = glm::vec3(1.0f);
    none.metallic = 1.0f;
    scene.chapter.phong[uint32_t(scene.materials.size() - 1)] = {}; // white, and no mirror
}

} // namespace onde::gltf
