#include "upload/appearance.h"

#include "core/error.h"
#include "scene/phong.h"
#include "upload/alias_table.h"
#include "upload/words.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace onde {

static uint32_t texture_index(int32_t index) {
    return index < 0 ? NO_INDEX : uint32_t(index);
}

std::vector<MaterialRecord> pack_materials(const Scene& scene) {
    static_assert(uint32_t(MaterialKind::metallic_roughness) == MATERIAL_METALLIC_ROUGHNESS);
    static_assert(uint32_t(MaterialKind::dielectric) == MATERIAL_DIELECTRIC);
    static_assert(uint32_t(MaterialKind::conductor) == MATERIAL_CONDUCTOR);
    std::vector<MaterialRecord> records;
    for (uint32_t i = 0; i < scene.materials.size(); i++) {
        const Material m = path_material(scene, i);
        MaterialRecord record{};
        record.kind = uint32_t(m.kind);
        record.two_sided = m.two_sided;
#define ONDE_COLOR(name) copy(record.name, m.name);
        MATERIAL_COLORS(ONDE_COLOR)
#undef ONDE_COLOR
#define ONDE_NUMBER(name) record.name = m.name;
        MATERIAL_NUMBERS(ONDE_NUMBER)
#undef ONDE_NUMBER
#define ONDE_TEXTURE(NAME, name) record.texture[TEXTURE_##NAME] = texture_index(m.name##_texture);
        TEXTURE_SLOTS(ONDE_TEXTURE)
#undef ONDE_TEXTURE
        records.push_back(record);
    }
    return records;
}

PackedTextures pack_textures(const Scene& scene) {
    PackedTextures packed;
    for (const Texture& texture : scene.textures) {
        const ByteImage& image = texture.image;
        const size_t count = size_t(image.width) * image.height, offset = packed.texels.size();
        if (offset + count > UINT32_MAX)
            throw InputError(
                "texture {}: all textures together exceed 2^32 texels; use smaller ones",
                texture.name);
        packed.records.push_back({uint32_t(offset),
                                  image.width,
                                  image.height,
                                  uint32_t(texture.wrap_u),
                                  uint32_t(texture.wrap_v),
                                  {}});
        packed.texels.resize(offset + count);
        std::memcpy(&packed.texels[offset], image.rgba.data(), count * 4);
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

PackedEnvironment pack_environment(const Environment& environment) {
    PackedEnvironment packed;
    if (!environment.map) return packed;
    const Image& map = *environment.map;
    packed.width = map.width;
    packed.height = map.height;
    packed.pixels = map.pixels;
    std::vector<double> weights(size_t(map.width) * map.height);
    for (uint32_t y = 0; y < map.height; y++) {
        const double sine = std::sin(std::numbers::pi * (y + 0.5) / map.height);
        for (uint32_t x = 0; x < map.width; x++) {
            const auto p = map.pixel(x, y);
            weights[size_t(y) * map.width + x] = sine * (double(p[0]) + p[1] + p[2]);
        }
    }
    packed.alias = build_alias_table(weights);
    return packed;
}

} // namespace onde
