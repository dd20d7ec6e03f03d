// Materials of glTF (section 3.9).
#include "core/shown.h"
#include "scene/gltf/numbers.h"
#include "scene/gltf/old_materials.h"
#include "scene/gltf/reachable.h"
#include "scene/gltf/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace onde::gltf {

namespace {

/// A number of an optional part of a material.
double number_in(const std::optional<JsonReader>& part, const char* key, double fallback) {
    return part ? part->number(key, fallback) : fallback;
}

void apply_emissive_strength(const JsonReader& source, Material& material) {
    const auto extended = source.extension("KHR_materials_emissive_strength");
    material.emission *= float(std::max(0.0, number_in(extended, "emissiveStrength", 1.0)));
}

void apply_ior(const JsonReader& source, Material& material) {
    const double ior = number_in(source.extension("KHR_materials_ior"), "ior", 1.5);
    // 0 stands for an index without end: all is reflected.
    material.ior = ior == 0.0 ? 100.0f : float(std::clamp(ior, 1.0, 100.0));
}

/// A surface that transmits without a volume behind it is a sheet (KHR_materials_volume).
void apply_transmission(TextureLoader& textures, const JsonReader& source, const std::string& user,
                        Material& material) {
    const auto extended = source.extension("KHR_materials_transmission");
    material.transmission = unit(number_in(extended, "transmissionFactor", 0.0));
    if (material.transmission > 0.0f)
        material.transmission_texture = textures.load(extended, "transmissionTexture", false, user);
    const auto volume = source.extension("KHR_materials_volume");
    material.thin_walled = !(number_in(volume, "thicknessFactor", 0.0) > 0.0);
    if (!volume || material.thin_walled) return;
    if (const auto color = volume->vector<3>("attenuationColor"))
        material.attenuation_color = glm::clamp(rgb(*color), 0.0f, 1.0f);
    const double distance = volume->number("attenuationDistance", 0.0);
    if (distance > 0.0) material.attenuation_distance = float(std::max(distance, 1e-30));
}

void apply_specular(TextureLoader& textures, const JsonReader& source, const std::string& user,
                    Material& material) {
    const auto extended = source.extension("KHR_materials_specular");
    if (!extended) return;
    material.specular = unit(extended->number("specularFactor", 1.0));
    if (const auto color = extended->vector<3>("specularColorFactor"))
        material.specular_color = glm::max(rgb(*color), 0.0f);
    material.specular_texture = textures.load(extended, "specularTexture", false, user);
    material.specular_color_texture = textures.load(extended, "specularColorTexture", true, user);
}

void apply_diffuse_transmission(TextureLoader& textures, const JsonReader& source,
                                const std::string& user, Material& material) {
    const auto extended = source.extension("KHR_materials_diffuse_transmission");
    if (!extended) return;
    material.diffuse_transmission = unit(extended->number("diffuseTransmissionFactor", 0.0));
    if (const auto color = extended->vector<3>("diffuseTransmissionColorFactor"))
        material.diffuse_transmission_color = glm::clamp(rgb(*color), 0.0f, 1.0f);
    material.diffuse_transmission_texture =
        textures.load(extended, "diffuseTransmissionTexture", false, user);
    material.diffuse_transmission_color_texture =
        textures.load(extended, "diffuseTransmissionColorTexture", true, user);
}

void apply_clearcoat(TextureLoader& textures, const JsonReader& source, const std::string& user,
                     Material& material) {
    const auto extended = source.extension("KHR_materials_clearcoat");
    if (!extended) return;
    material.clearcoat = unit(extended->number("clearcoatFactor", 0.0));
    if (material.clearcoat == 0.0f) return;
    material.clearcoat_roughness = unit(extended->number("clearcoatRoughnessFactor", 0.0));
    material.clearcoat_texture = textures.load(extended, "clearcoatTexture", false, user);
    material.clearcoat_roughness_texture =
        textures.load(extended, "clearcoatRoughnessTexture", false, user);
    material.clearcoat_normal_texture =
        textures.load(extended, "clearcoatNormalTexture", false, user);
    material.clearcoat_normal_scale =
        float(number_in(extended->object("clearcoatNormalTexture"), "scale", 1.0));
}

void apply_sheen(TextureLoader& textures, const JsonReader& source, const std::string& user,
                 Material& material) {
    const auto extended = source.extension("KHR_materials_sheen");
    if (!extended) return;
    if (const auto color = extended->vector<3>("sheenColorFactor"))
        material.sheen_color = glm::clamp(rgb(*color), 0.0f, 1.0f);
    if (material.sheen_color == glm::vec3(0.0f)) return;
    material.sheen_roughness = unit(extended->number("sheenRoughnessFactor", 0.0));
    material.sheen_color_texture = textures.load(extended, "sheenColorTexture", true, user);
    material.sheen_roughness_texture =
        textures.load(extended, "sheenRoughnessTexture", false, user);
}

void apply_iridescence(TextureLoader& textures, const JsonReader& source, const std::string& user,
                       Material& material) {
    const auto extended = source.extension("KHR_materials_iridescence");
    if (!extended) return;
    const auto not_negative = [&](const char* key, double fallback) {
        return float(std::max(0.0, extended->number(key, fallback)));
    };
    material.iridescence = unit(extended->number("iridescenceFactor", 0.0));
    if (material.iridescence == 0.0f) return;
    material.iridescence_ior =
        float(std::clamp(extended->number("iridescenceIor", 1.3), 1.0, 100.0));
    material.iridescence_thickness_minimum = not_negative("iridescenceThicknessMinimum", 100.0);
    material.iridescence_thickness = not_negative("iridescenceThicknessMaximum", 400.0);
    material.iridescence_texture = textures.load(extended, "iridescenceTexture", false, user);
    material.iridescence_thickness_texture =
        textures.load(extended, "iridescenceThicknessTexture", false, user);
}

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
    apply_emissive_strength(source, material);
    apply_ior(source, material);
    apply_specular(textures, source, user, material);
    apply_transmission(textures, source, user, material);
    apply_diffuse_transmission(textures, source, user, material);
    apply_clearcoat(textures, source, user, material);
    apply_sheen(textures, source, user, material);
    apply_iridescence(textures, source, user, material);
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
