#include "scene/obj/material.h"

#include "core/error.h"
#include "scene/opacity.h"
#include "scene/references.h"

#include <algorithm>
#include <cmath>

namespace onde {

namespace {

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

float opacity(const mtl::Material& source) {
    return source.opacity.value_or(1.0f - source.transparency.value_or(0.0f));
}

bool is_glass(const mtl::Material& source) {
    const auto illum = int(std::clamp(source.illumination, 0.0f, 10.0f));
    const bool refracts = illum == 4 || illum == 6 || illum == 7 || illum == 9;
    return refracts || (opacity(source) < 0.5f && source.ior > 1.0f);
}

bool is_mirror(const mtl::Material& source) {
    const glm::vec3 diffuse = source.diffuse.value_or(glm::vec3(0.0f));
    return source.illumination == 3.0f && source.diffuse_map.file.empty() &&
           largest(diffuse) <= 0.0f && largest(source.specular) > 0.0f;
}

/// Blinn-Phong's exponent as the roughness whose GGX lobe is as wide: alpha^2 = 2 / (Ns + 2)
/// (Walter et al., "Microfacet models for refraction", 2007, section 5.2).
float roughness_of_exponent(float exponent) {
    return std::pow(2.0f / (std::max(exponent, 0.0f) + 2.0f), 0.25f);
}

/// Visible where nothing is said. Exporters write Kd 0 beside a map that they mean to show.
glm::vec3 base_color(const mtl::Material& source) {
    const bool map = !source.diffuse_map.file.empty();
    const glm::vec3 color = source.diffuse.value_or(glm::vec3(map ? 1.0f : 0.8f));
    return map && largest(color) <= 0.0f ? glm::vec3(1.0f) : color;
}

void set_kind(const mtl::Material& source, Material& m) {
    if (is_glass(source)) {
        m.kind = MaterialKind::dielectric;
        m.ior = source.ior > 1.0f ? std::min(source.ior, 100.0f) : 1.5f;
        m.base_color = source.transmission;
        if (largest(m.base_color) <= 0.0f) m.base_color = glm::vec3(1.0f);
        m.roughness = 0.0f;
    } else if (source.roughness > 0.0f || source.metallic > 0.0f) {
        m.kind = MaterialKind::metallic_roughness;
        m.roughness = source.roughness > 0.0f ? source.roughness : 0.5f;
        m.metallic = source.metallic;
    } else if (is_mirror(source)) {
        m.kind = MaterialKind::conductor;
        m.base_color = source.specular;
        m.roughness = source.exponent >= 1000.0f ? 0.0f : roughness_of_exponent(source.exponent);
    } else if (largest(source.specular) > 0.0f && source.exponent > 1.0f) {
        m.kind = MaterialKind::metallic_roughness;
        m.roughness = roughness_of_exponent(source.exponent);
    }
}

void note_ignored(const mtl::Material& source, Notes& notes) {
    if (source.opacity && source.transparency &&
        std::abs(*source.opacity + *source.transparency - 1.0f) > 1e-3f)
        notes.wrong("Of d and Tr, which contradict each other, d counts", source.name);
    if (!source.emission_map.file.empty() && source.emission_map.moves_uvs())
        notes.add("Scale and offset of other maps than map_Kd are ignored", source.name);
}

/// The index of a map's texture, or NO_TEXTURE with a note.
int32_t texture(const mtl::Map& map, bool srgb, Scene& scene, FileFinder& files,
                const std::string& folder, Notes& notes) {
    if (map.file.empty()) return NO_TEXTURE;
    const auto found = files.find(map.file, folder);
    if (!found) {
        notes.wrong(files.may_use(map.file)
                        ? "Textures that are missing are left out"
                        : "Textures outside of the scene's folder are not allowed and left out",
                    map.file);
        return NO_TEXTURE;
    }
    const Wrap wrap = map.clamp ? Wrap::clamp : Wrap::repeat;
    try {
        return add_texture_file(scene, files.context(), files.folder(), *found, {srgb, wrap, wrap},
                                "");
    } catch (const OverBudget&) {
        throw;
    } catch (const InputError&) {
        notes.wrong("Textures that can't be read are left out", map.file);
        return NO_TEXTURE;
    }
}

/// The picture of a map, without leaving a texture in the scene for it; empty when it can't be had.
TexelImage picture(const mtl::Map& map, Scene& scene, FileFinder& files, const std::string& folder,
                   Notes& notes) {
    const size_t before = scene.textures.size();
    const int32_t index = texture(map, true, scene, files, folder, notes);
    if (index == NO_TEXTURE) return {};
    TexelImage image = image_of(scene.textures, scene.textures[size_t(index)]);
    if (scene.textures.size() > before) scene.textures.pop_back();
    return image;
}

/// Gives the base colour's texture the alpha of map_d, in a texture of its own.
void apply_opacity_map(const mtl::Material& source, Scene& scene, FileFinder& files,
                       const std::string& folder, Material& m, Notes& notes) {
    if (source.opacity_map.file.empty()) return;
    const TexelImage opacity = picture(source.opacity_map, scene, files, folder, notes);
    if (opacity.empty()) return;
    m.alpha_mode = AlphaMode::blend;
    const bool map = m.base_color_texture != NO_TEXTURE;
    const std::string base = map ? scene.textures[size_t(m.base_color_texture)].name : "white";
    const std::string name =
        base + " with the opacity of " + folder + "/" + source.opacity_map.file;
    const auto known = std::ranges::find(scene.textures, name, &Texture::name);
    if (known != scene.textures.end()) {
        m.base_color_texture = int32_t(known - scene.textures.begin());
        return;
    }
    TexelImage color;
    if (map) color = image_of(scene.textures, scene.textures[size_t(m.base_color_texture)]);
    TexelImage image = with_opacity(color, opacity);
    files.context().spend(image.bytes(), 1, name);
    const Wrap wrap = source.diffuse_map.clamp ? Wrap::clamp : Wrap::repeat;
    m.base_color_texture = add_texture(scene.textures, name, std::move(image), {true, wrap, wrap});
}

} // namespace

Material convert_mtl(const mtl::Material& source, Scene& scene, FileFinder& files,
                     const std::string& folder, Notes& notes) {
    const auto texture_of = [&](const mtl::Map& map, bool srgb) {
        return texture(map, srgb, scene, files, folder, notes);
    };
    Material m;
    m.name = source.name;
    m.base_color = base_color(source);
    set_kind(source, m);
    m.base_color = glm::clamp(m.base_color, 0.0f, 1.0f);
    m.roughness = std::clamp(m.roughness, 0.0f, 1.0f);
    m.metallic = std::clamp(m.metallic, 0.0f, 1.0f);
    m.emission = glm::max(source.emission, 0.0f);
    m.base_color_texture = texture_of(source.diffuse_map, true);
    if (!is_glass(source)) apply_opacity_map(source, scene, files, folder, m, notes);
    m.emission_texture = texture_of(source.emission_map, true);
    if (m.emission_texture != NO_TEXTURE && largest(m.emission) <= 0.0f)
        m.emission = glm::vec3(1.0f);
    m.normal_texture = texture_of(source.normal_map, false);
    m.normal_scale = source.normal_map.bump;
    if (!is_glass(source)) {
        m.alpha = std::clamp(opacity(source), 0.0f, 1.0f);
        if (m.alpha < 1.0f) m.alpha_mode = AlphaMode::blend;
    }
    note_ignored(source, notes);
    return m;
}

} // namespace onde
