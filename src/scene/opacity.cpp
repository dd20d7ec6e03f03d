#include "scene/opacity.h"

#include <algorithm>

namespace onde {

namespace {

bool has_alpha(const TexelImage& image) {
    for (size_t i = 3; i < image.samples(); i += 4)
        if (image.sample(i) < 1.0f) return true;
    return false;
}

/// The first sample of the texel of `image` that covers x, y of a picture of width x height.
size_t texel(const TexelImage& image, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    const uint64_t column = uint64_t(x) * image.width / width;
    const uint64_t row = uint64_t(y) * image.height / height;
    return 4 * (row * image.width + column);
}

void set_code(TexelImage& image, size_t at, uint32_t value) {
    image.rgba[at] = uint8_t(value >> 8);
    if (!image.low.empty()) image.low[at] = uint8_t(value);
}

/// A white picture as precise as `color`, and in codes as its opacity is.
TexelImage white(const TexelImage& color, const TexelImage& opacity) {
    TexelImage image;
    image.width = std::max(color.width, opacity.width);
    image.height = std::max(color.height, opacity.height);
    const size_t samples = size_t(4) * image.width * image.height;
    if (color.is_linear()) {
        image.floats.assign(samples, 1.0f);
        return image;
    }
    image.rgba.assign(samples, 255);
    if (!color.low.empty() || !opacity.low.empty() || opacity.is_linear()) image.low = image.rgba;
    return image;
}

/// Sets a sample to one that is stored in another picture. Floats become codes only where these are
/// linear: of alpha.
void copy_sample(TexelImage& to, size_t at, const TexelImage& from, size_t source) {
    if (to.is_linear())
        to.floats[at] = from.sample(source);
    else if (from.is_linear())
        set_code(to, at, uint32_t(std::min(from.floats[source], 1.0f) * 65535.0f + 0.5f));
    else
        set_code(to, at, from.code(source));
}

} // namespace

TexelImage with_opacity(const TexelImage& color, const TexelImage& opacity, OpacityChannel wanted) {
    const size_t channel = wanted == OpacityChannel::alpha_or_red && has_alpha(opacity) ? 3 : 0;
    TexelImage result = white(color, opacity);
    for (uint32_t y = 0; y < result.height; ++y)
        for (uint32_t x = 0; x < result.width; ++x) {
            const size_t out = 4 * (size_t(y) * result.width + x);
            if (!color.empty()) {
                const size_t from = texel(color, x, y, result.width, result.height);
                for (size_t c = 0; c < 3; ++c) copy_sample(result, out + c, color, from + c);
            }
            const size_t from = texel(opacity, x, y, result.width, result.height);
            copy_sample(result, out + 3, opacity, from + channel);
        }
    return result;
}

} // namespace onde
