#include "image/tone.h"

#include <cmath>

namespace onde {

float srgb_from_linear(float linear) {
    const float x = std::abs(linear);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    return std::copysign(encoded, linear);
}

float linear_from_srgb(float encoded) {
    const float x = std::abs(encoded);
    const float linear = x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
    return std::copysign(linear, encoded);
}

float filmic(float linear) {
    // Beyond here the curve is above 1; leaving early also keeps infinity from giving inf / inf.
    constexpr float CLIP = 7.3f;
    if (!(linear > 0)) return 0;
    if (linear > CLIP) return 1;
    const float x = linear;
    return std::fmin(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 1.0f);
}

/// fmax first: it turns NaN into 0.
static uint8_t byte(float value) {
    return uint8_t(std::lround(255 * std::fmin(std::fmax(value, 0.0f), 1.0f)));
}

std::vector<uint8_t> display_bytes(const Image& image, const Display& display) {
    const float scale = std::exp2(display.exposure);
    std::vector<uint8_t> bytes(image.pixels.size());
    for (size_t i = 0; i < bytes.size(); ++i) {
        const float exposed = scale * image.pixels[i];
        const bool is_alpha = image.channels == 4 && i % 4 == 3;
        if (is_alpha)
            bytes[i] = byte(image.pixels[i]);
        else
            bytes[i] = byte(
                srgb_from_linear(display.tone_map == ToneMap::filmic ? filmic(exposed) : exposed));
    }
    return bytes;
}

} // namespace onde
