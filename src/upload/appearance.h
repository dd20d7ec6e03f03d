// Materials and textures as device records.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

#include <cstdint>
#include <vector>

namespace onde {

std::vector<MaterialRecord> pack_materials(const Scene& scene);

/// The sets of texture coordinates that the scene's textures use, ascending; at least one. They are
/// packed in this order.
std::vector<uint32_t> used_uv_sets(const Scene& scene);

struct PackedTextures {
    std::vector<TextureRecord> records;
    std::vector<uint32_t>
        texels; ///< RGBA8, red lowest; of 16 bits the higher bytes, then the lower
};
/// Throws InputError beyond 2^32 texels.
PackedTextures pack_textures(const Scene& scene);

/// Linear values of the 256 sRGB codes (IEC 61966-2-1).
std::vector<float> srgb_table();

} // namespace onde
