#include "scene/obj_material.h"

#include "core/error.h"
#include "scene/references.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>

namespace onde {

namespace {

glm::vec3 color(const float (&rgb)[3]) {
    return glm::vec3(rgb[0], rgb[1], rgb[2]);
}

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

bool is_finite(const tinyobj::material_t& m) {
    const glm::vec3 sum =
        color(m.diffuse) + color(m.specular) + color(m.transmittance) + color(m.emission);
    return std::isfinite(sum.x + sum.y + sum.z + m.shininess + m.ior + m.dissolve + m.roughness +
                         m.metallic);
}

bool is_glass(const tinyobj::material_t& m) {
    const bool refracts = m.illum == 4 || m.illum == 6 || m.illum == 7 || m.illum == 9;
    return refracts || (m.dissolve < 0.5f && m.ior > 1.0f);
}

/// Blinn-Phong's exponent as the roughness whose GGX lobe is as wide: alpha^2 = 2 / (Ns + 2)
/// (Walter et al., "Microfacet models for refraction", 2007, section 5.2).
float roughness_of_exponent(float exponent) {
    return std::pow(2.0f / (std::max(exponent, 0.0f) + 2.0f), 0.25f);
}

void set_kind(const tinyobj::material_t& source, Material& m) {
    const glm::vec3 specular = color(source.specular), diffuse = color(source.diffuse);
    if (is_glass(source)) {
        m.kind = MaterialKind::dielectric;
        m.ior = source.ior > 1.0f ? std::min(source.ior, 100.0f) : 1.5f;
        m.base_color = color(source.transmittance);
        if (largest(m.base_color) <= 0.0f) m.base_color = glm::vec3(1.0f);
        m.roughness = 0.0f;
    } else if (source.roughness > 0.0f || source.metallic > 0.0f) {
        m.kind = MaterialKind::metallic_roughness;
        m.roughness = source.roughness > 0.0f ? source.roughness : 0.5f;
        m.metallic = source.metallic;
    } else if (source.illum == 3 && largest(diffuse) <= 0.0f && largest(specular) > 0.0f) {
        m.kind = MaterialKind::conductor;
        m.base_color = specular;
        m.roughness = source.shininess >= 1000.0f ? 0.0f : roughness_of_exponent(source.shininess);
    } else if (largest(specular) > 0.0f && source.shininess > 1.0f) {
        m.kind = MaterialKind::metallic_roughness;
        m.roughness = roughness_of_exponent(source.shininess);
    }
}

void note_ignored(const tinyobj::material_t& source, Notes& notes) {
    if (!is_glass(source) && (source.dissolve < 1.0f || !source.alpha_texname.empty()))
        notes.add("Partial opacity is rendered opaque", source.name);
    if (!source.bump_texname.empty()) notes.add("Bump maps are ignored", source.name);
    if (!source.specular_texname.empty()) notes.add("Specular maps are ignored", source.name);
    if (!source.roughness_texname.empty() || !source.metallic_texname.empty())
        notes.add("Separate roughness and metallic maps are ignored", source.name);
}

/// Windows' separators are common in MTL files.
std::string with_slashes(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

} // namespace

Material convert_mtl(const tinyobj::material_t& source, Scene& scene,
                     const std::filesystem::path& folder, const std::string& where, Notes& notes) {
    if (!is_finite(source))
        throw InputError("{}: material '{}' has a number that is not finite; correct it", where,
                         source.name);
    const auto texture = [&](const std::string& name, const tinyobj::texture_option_t& option,
                             bool srgb) {
        if (name.empty()) return NO_TEXTURE;
        const Wrap wrap = option.clamp ? Wrap::clamp : Wrap::repeat;
        return add_texture_file(scene, folder, with_slashes(name), {srgb, wrap, wrap},
                                where + ": material '" + source.name + "'");
    };
    Material m;
    m.name = source.name;
    m.base_color = color(source.diffuse);
    m.base_color_texture = texture(source.diffuse_texname, source.diffuse_texopt, true);
    // Exporters write Kd 0 beside a map that they mean to show.
    if (m.base_color_texture != NO_TEXTURE && largest(m.base_color) <= 0.0f)
        m.base_color = glm::vec3(1.0f);
    set_kind(source, m);
    m.base_color = glm::clamp(m.base_color, 0.0f, 1.0f);
    m.roughness = std::clamp(m.roughness, 0.0f, 1.0f);
    m.metallic = std::clamp(m.metallic, 0.0f, 1.0f);
    m.emission = glm::max(color(source.emission), 0.0f);
    m.emission_texture = texture(source.emissive_texname, source.emissive_texopt, true);
    if (m.emission_texture != NO_TEXTURE && largest(m.emission) <= 0.0f)
        m.emission = glm::vec3(1.0f);
    m.normal_texture = texture(source.normal_texname, source.normal_texopt, false);
    note_ignored(source, notes);
    return m;
}

} // namespace onde
