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

/// 8-bit RGBA as textures store it, origin top left, not linearised.
/// `rgba.size() == 4 * width * height`.
struct ByteImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
};

} // namespace onde
