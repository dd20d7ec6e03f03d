#include "image/tone.h"

#include <algorithm>
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

float linear_sample(const TexelImage& image, size_t at, bool srgb) {
    const float stored = image.sample(at);
    return srgb && !image.is_linear() ? linear_from_srgb(stored) : stored;
}

float filmic(float linear) {
    // Beyond here the curve is above 1; leaving early also keeps infinity from giving inf / inf.
    constexpr float CLIP = 7.3f;
    if (!(linear > 0)) return 0;
    if (linear > CLIP) return 1;
    const float x = linear;
    return std::fmin(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 1.0f);
}

static float largest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

glm::vec3 neutral(glm::vec3 linear) {
    constexpr float REFLECTED = 0.04f, SHOULDER = 0.8f - REFLECTED, FADING = 0.15f;
    const glm::vec3 color = glm::max(glm::vec3(0.0f), linear); // of NaN and 0 the first
    const float least = std::min({color.x, color.y, color.z});
    const float offset = least < 2 * REFLECTED ? least - 6.25f * least * least : REFLECTED;
    const glm::vec3 base = color - offset;
    const float peak = largest(base);
    if (peak < SHOULDER) return base;
    if (std::isinf(peak)) return glm::vec3(1.0f);
    constexpr float ROOM = 1 - SHOULDER;
    const float compressed = 1 - ROOM * ROOM / (peak + ROOM - SHOULDER);
    const float white = 1 - 1 / (FADING * (peak - compressed) + 1);
    return glm::mix(base * (compressed / peak), glm::vec3(compressed), white);
}

/// From the place in AgX's range of stops, 0 to 1, to an encoded value. Middle grey, at 20/33, is
/// 0.5.
static float agx_curve(float place) {
    constexpr float MIDDLE = 20.0f / 33, SLOPE = 2;
    const float t = place - MIDDLE;
    const float bend = t < 0 ? std::pow(1 - 59.507875f * t * t * t, -1.0f / 3)
                             : std::pow(1 + 69.862789f * std::pow(t, 3.25f), -1 / 3.25f);
    return 0.5f + SLOPE * t * bend;
}

glm::vec3 agx(glm::vec3 linear) {
    constexpr float LOW = -12.473931f, HIGH = 4.026069f; // in stops
    constexpr glm::mat3 INSET{0.84240107f, 0.04240107f, 0.04240107f, 0.07843650f, 0.87843650f,
                              0.07843650f, 0.07916243f, 0.07916243f, 0.87916243f};
    constexpr glm::mat3 OUTSET{1.19699866f,  -0.05300134f, -0.05300134f, -0.09804563f, 1.15195437f,
                               -0.09804563f, -0.09895303f, -0.09895303f, 1.15104697f};
    constexpr float MOST = 1e30f; // the matrix must not make inf - inf
    const glm::vec3 color = INSET * glm::min(glm::max(glm::vec3(0.0f), linear), glm::vec3(MOST));
    glm::vec3 encoded;
    for (glm::length_t k = 0; k < 3; k++) {
        const float stops = std::clamp(std::log2(color[k]), LOW, HIGH);
        encoded[k] = agx_curve((stops - LOW) / (HIGH - LOW));
    }
    const glm::vec3 shown = glm::clamp(OUTSET * encoded, 0.0f, 1.0f);
    return {linear_from_srgb(shown.x), linear_from_srgb(shown.y), linear_from_srgb(shown.z)};
}

static glm::vec3 mapped(glm::vec3 color, ToneMap tone_map) {
    switch (tone_map) {
    case ToneMap::filmic:
        return {filmic(color.x), filmic(color.y), filmic(color.z)};
    case ToneMap::neutral:
        return neutral(color);
    case ToneMap::agx:
        return agx(color);
    case ToneMap::none:
        break;
    }
    return color;
}

/// fmax first: it turns NaN into 0.
static uint8_t byte(float value) {
    return uint8_t(std::lround(255 * std::fmin(std::fmax(value, 0.0f), 1.0f)));
}

Image with_alpha(const Image& colors, const Image& alpha) {
    Image picture(colors.width, colors.height, 4);
    for (size_t i = 0; i < alpha.pixels.size(); i++) {
        std::copy_n(&colors.pixels[3 * i], 3, &picture.pixels[4 * i]);
        picture.pixels[4 * i + 3] = alpha.pixels[i];
    }
    return picture;
}

Image straight_alpha(Image image) {
    if (image.channels != 4) return image;
    for (size_t i = 0; i < image.pixels.size(); i += 4)
        for (size_t k = 0; k < 3 && image.pixels[i + 3] > 0; k++)
            image.pixels[i + k] /= image.pixels[i + 3];
    return image;
}

std::vector<uint8_t> display_bytes(const Image& image, const Display& display) {
    const float scale = std::exp2(display.exposure);
    const size_t channels = image.channels, colors = std::min<size_t>(channels, 3);
    std::vector<uint8_t> bytes(image.pixels.size());
    for (size_t first = 0; first < bytes.size(); first += channels) {
        glm::vec3 color(scale * image.pixels[first]); // grey, unless there is more
        for (size_t k = 1; k < colors; k++)
            color[glm::length_t(k)] = scale * image.pixels[first + k];
        color = mapped(color, display.tone_map);
        for (size_t k = 0; k < colors; k++)
            bytes[first + k] = byte(srgb_from_linear(color[glm::length_t(k)]));
        if (channels == 4) bytes[first + 3] = byte(image.pixels[first + 3]);
    }
    return bytes;
}

} // namespace onde
