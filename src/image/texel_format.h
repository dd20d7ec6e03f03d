// How texels lie in a device's memory, by what their picture needs to keep all it says.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <optional>

namespace onde {

/// The values are TEXEL_... of shared/scene.h.
enum class TexelFormat : uint32_t {
    bytes,  ///< codes of 8 bits
    wide,   ///< codes of 16
    halves, ///< floats that halves hold
    floats,
};

TexelFormat texel_format(const TexelImage& image);

/// 32-bit words of a texel.
uint32_t texel_words(const TexelImage& image);

/// What the picture takes on a device, without coarser levels.
uint64_t device_bytes(const TexelImage& image);

/// The half (IEEE 754 binary16) of a finite number from 0 on, where it is no further from it than
/// 2^-25, half of the least one: all of its digits, but for those below.
std::optional<uint16_t> exact_half(float x);

/// The nearest half of such a number, at most 65504.
float nearest_half(float x);

} // namespace onde
