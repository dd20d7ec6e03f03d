#include "scene/opacity.h"

#include <algorithm>

namespace onde {

namespace {

bool has_alpha(const ByteImage& image) {
    for (size_t i = 3; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != 255) return true;
    return false;
}

/// The first sample of the texel of `image` that covers x, y of a picture of width x height.
size_t texel(const ByteImage& image, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    const uint64_t column = uint64_t(x) * image.width / width;
    const uint64_t row = uint64_t(y) * image.height / height;
    return 4 * (row * image.width + column);
}

void set_wide(ByteImage& image, size_t at, uint32_t value) {
    image.rgba[at] = uint8_t(value >> 8);
    if (!image.low.empty()) image.low[at] = uint8_t(value);
}

} // namespace

ByteImage with_opacity(const ByteImage& color, const ByteImage& opacity, OpacityChannel wanted) {
    const size_t channel = wanted == OpacityChannel::alpha_or_red && has_alpha(opacity) ? 3 : 0;
    ByteImage result;
    result.width = std::max(color.width, opacity.width);
    result.height = std::max(color.height, opacity.height);
    result.rgba.assign(size_t(4) * result.width * result.height, 255);
    if (!color.low.empty() || !opacity.low.empty()) result.low = result.rgba;
    for (uint32_t y = 0; y < result.height; ++y)
        for (uint32_t x = 0; x < result.width; ++x) {
            const size_t out = 4 * (size_t(y) * result.width + x);
            if (!color.rgba.empty()) {
                const size_t from = texel(color, x, y, result.width, result.height);
                for (size_t c = 0; c < 3; ++c) set_wide(result, out + c, color.wide(from + c));
            }
            const size_t from = texel(opacity, x, y, result.width, result.height);
            set_wide(result, out + 3, opacity.wide(from + channel));
        }
    return result;
}

} // namespace onde
