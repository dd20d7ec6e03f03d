#include "scene/gltf/material_extensions.h"

#include "scene/gltf/numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde::gltf {

namespace {

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
    const auto volume = source.extension("KHR_materials_volume");
    if (material.transmission == 0.0f) return;
    material.transmission_texture = textures.load(extended, "transmissionTexture", false, user);
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

void apply_anisotropy(TextureLoader& textures, const JsonReader& source, const std::string& user,
                      Material& material) {
    const auto extended = source.extension("KHR_materials_anisotropy");
    if (!extended) return;
    material.anisotropy = unit(extended->number("anisotropyStrength", 0.0));
    if (material.anisotropy == 0.0f) return;
    material.anisotropy_rotation =
        float(std::remainder(extended->number("anisotropyRotation", 0.0), 2.0 * std::numbers::pi));
    material.anisotropy_texture = textures.load(extended, "anisotropyTexture", false, user);
}

void apply_dispersion(const JsonReader& source, Material& material) {
    const double dispersion =
        number_in(source.extension("KHR_materials_dispersion"), "dispersion", 0.0);
    material.dispersion = float(std::clamp(dispersion, 0.0, 100.0));
}

} // namespace

void apply_extensions(TextureLoader& textures, const JsonReader& source, const std::string& user,
                      Material& material) {
    apply_emissive_strength(source, material);
    apply_ior(source, material);
    apply_specular(textures, source, user, material);
    apply_transmission(textures, source, user, material);
    apply_diffuse_transmission(textures, source, user, material);
    apply_clearcoat(textures, source, user, material);
    apply_sheen(textures, source, user, material);
    apply_iridescence(textures, source, user, material);
    apply_anisotropy(textures, source, user, material);
    apply_dispersion(source, material);
}

} // namespace onde::gltf
