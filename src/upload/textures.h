// Textures as device records, and their texels in as many buffers as they need.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace onde {

/// The sets of texture coordinates that the scene's textures use, ascending; at least one. They are
/// packed in this order.
std::vector<uint32_t> used_uv_sets(const Scene& scene);

struct TextureOptions {
    uint64_t largest_buffer = UINT64_MAX; ///< bytes that the device allows
};

struct PackedTextures {
    std::vector<TextureRecord> records;
    std::array<std::vector<uint32_t>, TEXEL_BUFFER_COUNT> texels; ///< see TextureRecord
};
/// Each picture, and each of its levels, lies in one buffer, the first that has room. Throws
/// InputError where none has.
PackedTextures pack_textures(const Scene& scene, const TextureOptions& options = {});

/// Linear values of the 256 sRGB codes (IEC 61966-2-1).
std::vector<float> srgb_table();

} // namespace onde
