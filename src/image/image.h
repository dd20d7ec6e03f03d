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

/// RGBA as textures store it, origin top left: codes of 8 bits or of 16, not linearised, or floats,
/// which are linear, colours too. Codes of 16 bits have the higher byte of each sample in `rgba`
/// and the lower one in `low`, which is as large or empty; empty stands for a copy of `rgba`: 255
/// is 65535. `rgba.size()`, or `floats.size()` beside an empty `rgba`, is 4 * width * height.
struct TexelImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;
    std::vector<uint8_t> low{};
    std::vector<float> floats{}; ///< finite, not negative; alpha is at most 1
    uint64_t cut = 0; ///< pixels of floats that had a negative, infinite or meaningless sample

    bool is_linear() const { return !floats.empty(); }
    size_t samples() const { return is_linear() ? floats.size() : rgba.size(); }
    bool empty() const { return samples() == 0; }
    /// A sample as it is stored; codes are in 0 to 1.
    float sample(size_t at) const { return is_linear() ? floats[at] : float(code(at)) / 65535.0f; }
    /// A sample of codes, as if of 16 bits.
    uint32_t code(size_t at) const { return rgba[at] * 256u + (low.empty() ? rgba[at] : low[at]); }
    uint64_t bytes() const { return rgba.size() + low.size() + sizeof(float) * floats.size(); }
};

} // namespace onde
