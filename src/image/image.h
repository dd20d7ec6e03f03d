// A picture in memory: linear floats, row by row from the top.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace onde {

/// Interleaved floating-point pixels, origin top left. `pixels.size() == width * height *
/// channels`.
struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 3;
    std::vector<float> pixels;

    Image() = default;
    Image(uint32_t w, uint32_t h, uint32_t c)
        : width(w), height(h), channels(c), pixels(size_t(w) * h * c) {}

    std::span<float> pixel(uint32_t x, uint32_t y) {
        return {&pixels[(size_t(y) * width + x) * channels], channels};
    }
    std::span<const float> pixel(uint32_t x, uint32_t y) const {
        return {&pixels[(size_t(y) * width + x) * channels], channels};
    }
};

/// RGBA as textures store it, origin top left, not linearised, of 8 bits or of 16: those have the
/// higher byte of each sample in `rgba` and the lower one in `low`. `rgba.size() == 4 * width *
/// height`; `low` is as large or empty, which stands for a copy of `rgba`: 255 is 65535.
struct ByteImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
    std::vector<uint8_t> low{};
    bool from_floats = false; ///< which are linear, colours too
    uint64_t cut = 0; ///< pixels of floats that had a negative, infinite or meaningless sample

    /// A sample of 16 bits.
    uint32_t wide(size_t at) const { return rgba[at] * 256u + (low.empty() ? rgba[at] : low[at]); }
    uint64_t bytes() const { return rgba.size() + low.size(); }
};

} // namespace onde
