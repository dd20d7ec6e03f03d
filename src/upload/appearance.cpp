#include "upload/appearance.h"

#include "core/error.h"
#include "scene/light_groups.h"
#include "scene/phong.h"
#include "upload/albedo_tables.h"
#include "upload/media.h"
#include "upload/spectrum_table.h"
#include "upload/words.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

namespace onde {

static uint32_t texture_index(int32_t index) {
    return index < 0 ? NO_INDEX : uint32_t(index);
}

/// The smallest alpha of a picture.
static float least_alpha(const ByteImage& image) {
    uint32_t least = 65535;
    for (size_t i = 3; i < image.rgba.size(); i += 4) least = std::min(least, image.wide(i));
    return float(least) / 65535.0f;
}

/// The smallest alpha of the vertices of each material's triangles.
static std::vector<float> least_vertex_alphas(const Scene& scene) {
    std::vector<float> least(scene.materials.size(), 1.0f);
    for (const Mesh& mesh : scene.meshes)
        for (size_t t = 0; !mesh.colors.empty() && t < mesh.triangles.size(); t++)
            for (glm::length_t k = 0; k < 3; k++) {
                float& alpha = least[mesh.materials[t]];
                alpha = std::min(alpha, mesh.colors[mesh.triangles[t][k]].a);
            }
    return least;
}

namespace {

/// Finds materials whose alpha does nothing: many files say that what is opaque blends.
class AlphaModes {
  public:
    explicit AlphaModes(const Scene& scene) : scene_(scene) {
        for (const Material& m : scene.materials) used_ |= m.alpha_mode != AlphaMode::opaque;
        if (used_) vertices_ = least_vertex_alphas(scene);
        textures_.assign(scene.textures.size(), -1.0f);
    }

    uint32_t of(uint32_t index) {
        const Material& m = scene_.materials[index];
        if (m.alpha_mode == AlphaMode::opaque) return ALPHA_OPAQUE;
        const float least = m.alpha * vertices_[index] * of_texture(m.base_color_texture);
        const float enough = m.alpha_mode == AlphaMode::mask ? m.alpha_cutoff : 1.0f;
        return least >= enough ? ALPHA_OPAQUE : uint32_t(m.alpha_mode);
    }

  private:
    float of_texture(int32_t index) {
        if (index == NO_TEXTURE) return 1.0f;
        float& least = textures_[size_t(index)];
        if (least < 0.0f)
            least = least_alpha(image_of(scene_.textures, scene_.textures[size_t(index)]));
        return least;
    }

    const Scene& scene_;
    bool used_ = false;
    std::vector<float> vertices_, textures_; ///< least alphas; textures' are -1 until asked for
};

} // namespace

static constexpr uint32_t bit(uint32_t index) {
    return 1u << index;
}

static bool is_rough_alpha(float roughness) {
    return roughness * roughness >= SMOOTH_ALPHA;
}

/// The boundary of a medium that bends no light lets all of it through as a sheet does, which
/// light from lights finds.
static bool is_sheet(const Material& m) {
    return m.thin_walled || (m.medium && std::abs(m.ior - 1) < 1e-4f);
}
static uint32_t clear_lobe(const Material& m) {
    return bit(is_sheet(m) ? LOBE_THIN : LOBE_DIELECTRIC);
}

uint32_t lobes_of(const Material& m) {
    switch (m.kind) {
    case MaterialKind::diffuse:
        return bit(LOBE_DIFFUSE);
    case MaterialKind::conductor:
        return bit(LOBE_GLOSSY);
    case MaterialKind::dielectric:
        return clear_lobe(m);
    case MaterialKind::metallic_roughness:
        return bit(LOBE_GLOSSY) | bit(LOBE_DIFFUSE) | (m.transmission > 0 ? clear_lobe(m) : 0) |
               (m.diffuse_transmission > 0 ? bit(LOBE_BEHIND) : 0) |
               (m.clearcoat > 0 ? bit(LOBE_COAT) : 0) |
               (m.sheen_color != glm::vec3(0) ? bit(LOBE_SHEEN) : 0);
    case MaterialKind::unlit:
    case MaterialKind::phong: // path_material() has made something else of it
        break;
    }
    return 0;
}

MaterialFeatures features_of(const Material& m) {
    const uint32_t lobes = lobes_of(m);
    const bool mixed = m.kind == MaterialKind::metallic_roughness;
    const bool solid = lobes & bit(LOBE_DIELECTRIC), thin = lobes & bit(LOBE_THIN);
    // Textures only lower the roughness.
    const bool may_be_rough = is_rough_alpha(m.roughness);
    const bool may_be_smooth = !may_be_rough || m.metallic_roughness_texture != NO_TEXTURE;
    MaterialFeatures features{};
    constexpr uint32_t MIRRORING_LOBES = bit(LOBE_GLOSSY) | bit(LOBE_DIELECTRIC) | bit(LOBE_THIN);
    features.anisotropy = lobes & bit(LOBE_GLOSSY) && m.anisotropy > 0;
    features.rough = (may_be_rough && (lobes & MIRRORING_LOBES)) || features.anisotropy ||
                     (lobes & bit(LOBE_COAT) && is_rough_alpha(m.clearcoat_roughness));
    features.rough_glass = may_be_rough && solid;
    features.beckmann =
        m.distribution == Distribution::beckmann && may_be_rough && (lobes & MIRRORING_LOBES);
    features.albedos =
        mixed || thin || features.anisotropy || (may_be_rough && lobes & bit(LOBE_GLOSSY));
    features.index = mixed && m.ior != 1.5f;
    features.specular =
        mixed && (m.specular != 1 || m.specular_color != glm::vec3(1) ||
                  m.specular_texture != NO_TEXTURE || m.specular_color_texture != NO_TEXTURE);
    features.iridescence = mixed && m.iridescence > 0;
    features.edges = lobes & bit(LOBE_GLOSSY) && m.edge_tint != glm::vec3(1);
    features.inner = mixed && m.inner_reflection.has_value();
    features.dispersion = solid && m.dispersion > 0;
    features.transmission = mixed && m.transmission > 0;
    features.absorption = solid && m.attenuation_distance && m.attenuation_color != glm::vec3(1);
    features.pane = thin && may_be_smooth;
    features.unbent = solid && may_be_smooth && m.shadows == GlassShadows::straight;
    return features;
}

/// Halvings per unit of length, in the solid.
static glm::vec3 absorption_of(const Material& m) {
    if (!features_of(m).absorption) return glm::vec3(0);
    // Black would be infinite; what is left of it after the distance is nothing to be seen.
    return -glm::log2(glm::max(m.attenuation_color, 1e-6f)) / *m.attenuation_distance;
}

static float number_of(float number) {
    return number;
}
/// Those that may be absent are not negative.
static float number_of(const std::optional<float>& number) {
    return number.value_or(-1.0f);
}

PackedMaterials pack_materials(const Scene& scene) {
    static_assert(uint32_t(MaterialKind::unlit) == MATERIAL_UNLIT);
    static_assert(uint32_t(AlphaMode::mask) == ALPHA_MASK);
    static_assert(uint32_t(AlphaMode::blend) == ALPHA_BLEND);
    static_assert(uint32_t(MaterialKind::metallic_roughness) == MATERIAL_METALLIC_ROUGHNESS);
    static_assert(uint32_t(MaterialKind::dielectric) == MATERIAL_DIELECTRIC);
    static_assert(uint32_t(MaterialKind::conductor) == MATERIAL_CONDUCTOR);
    PackedMaterials packed;
    AlbedoTables albedos;
    AlphaModes alpha_modes(scene);
    const LightGroups groups(scene);
    std::vector<uint32_t> inside(scene.materials.size(), NO_INDEX);
    if (has_media(scene)) {
        PackedMedia all = pack_media(scene, inside);
        packed.media = std::move(all.media);
        packed.grids = std::move(all.grids);
    }
    for (uint32_t i = 0; i < scene.materials.size(); i++) {
        const Material m = path_material(scene, i);
        MaterialRecord record{};
        record.kind = uint32_t(m.kind);
        record.lobes = lobes_of(m);
        const MaterialFeatures features = features_of(m);
        if (features.albedos) albedos.reflection();
        if (features.anisotropy) albedos.grain();
        if (record.lobes & bit(LOBE_SHEEN)) albedos.sheen();
        if (features.dispersion && packed.spectrum.empty()) packed.spectrum = spectrum_table();
        if (features.beckmann) albedos.beckmann();
        if (features.rough_glass) record.albedos = albedos.glass(m.ior, m.distribution);
        record.beckmann = features.beckmann;
        record.blocks = m.shadows == GlassShadows::opaque;
        copy(record.absorption, absorption_of(m));
        record.medium = inside[i];
        record.other = m.blend_with.value_or(NO_INDEX);
        record.grain[0] = std::cos(m.anisotropy_rotation);
        record.grain[1] = std::sin(m.anisotropy_rotation);
        record.two_sided = m.two_sided;
        record.alpha_mode = alpha_modes.of(i);
        record.group = groups(m.group);
        record.double_sided =
            m.double_sided || record.lobes & (bit(LOBE_DIELECTRIC) | bit(LOBE_THIN));
#define ONDE_COLOR(name) copy(record.name, m.name);
        MATERIAL_COLORS(ONDE_COLOR)
#undef ONDE_COLOR
#define ONDE_NUMBER(name) record.name = number_of(m.name);
        MATERIAL_NUMBERS(ONDE_NUMBER)
#undef ONDE_NUMBER
#define ONDE_TEXTURE(NAME, name) record.texture[TEXTURE_##NAME] = texture_index(m.name##_texture);
        TEXTURE_SLOTS(ONDE_TEXTURE)
#undef ONDE_TEXTURE
        packed.records.push_back(record);
    }
    packed.albedos = std::move(albedos).words();
    return packed;
}

std::vector<uint32_t> used_uv_sets(const Scene& scene) {
    std::set<uint32_t> sets;
    for (const Texture& texture : scene.textures) sets.insert(texture.uv_set);
    if (sets.empty()) sets.insert(0);
    return {sets.begin(), sets.end()};
}

/// All of a record but the place and size of its texels.
static TextureRecord texture_record(const Texture& texture, const std::vector<uint32_t>& sets) {
    TextureRecord record{};
    record.wrap_u = uint32_t(texture.wrap_u);
    record.wrap_v = uint32_t(texture.wrap_v);
    record.filter = uint32_t(texture.filter);
    record.uv_set = uint32_t(std::ranges::find(sets, texture.uv_set) - sets.begin());
    const glm::vec2 origin = texture.transform({0, 0});
    const glm::vec2 x = texture.transform({1, 0}) - origin, y = texture.transform({0, 1}) - origin;
    copy(record.u, glm::vec3(x.x, y.x, origin.x));
    copy(record.v, glm::vec3(x.y, y.y, origin.y));
    return record;
}

/// Appends RGBA bytes as words; returns the index of the first.
static uint32_t append(std::vector<uint32_t>& texels, const std::vector<uint8_t>& rgba) {
    const size_t offset = texels.size();
    texels.resize(offset + rgba.size() / 4);
    if (!rgba.empty()) std::memcpy(&texels[offset], rgba.data(), rgba.size());
    return uint32_t(offset);
}

PackedTextures pack_textures(const Scene& scene) {
    static_assert(uint32_t(TextureFilter::nearest) == FILTER_NEAREST);
    PackedTextures packed;
    uint64_t bytes = 0;
    for (const Texture& texture : scene.textures) bytes += texture.image.bytes();
    if (bytes / 4 > UINT32_MAX)
        throw InputError("all textures together exceed 2^32 texels; use smaller ones");
    packed.texels.reserve(bytes / 4); // growing would take half as much again
    const std::vector<uint32_t> sets = used_uv_sets(scene);
    for (const Texture& texture : scene.textures) {
        TextureRecord record = texture_record(texture, sets);
        if (texture.same_image_as != NO_TEXTURE) {
            const TextureRecord& same = packed.records[size_t(texture.same_image_as)];
            record.offset = same.offset;
            record.low = same.low;
            record.width = same.width;
            record.height = same.height;
            packed.records.push_back(record);
            continue;
        }
        const ByteImage& image = texture.image;
        record.offset = append(packed.texels, image.rgba);
        record.low = image.low.empty() ? record.offset : append(packed.texels, image.low);
        record.width = image.width;
        record.height = image.height;
        packed.records.push_back(record);
    }
    return packed;
}

std::vector<float> srgb_table() {
    std::vector<float> table(256);
    for (int i = 0; i < 256; i++) {
        const double c = i / 255.0;
        table[size_t(i)] = float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
}

} // namespace onde
