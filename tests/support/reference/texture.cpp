#include "support/reference/texture.h"

#include <algorithm>
#include <cmath>

namespace onde::reference {
namespace {

int wrapped(int i, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp(i, 0, size - 1);
    const int period = wrap == Wrap::mirror ? 2 * size : size;
    const int j = ((i % period) + period) % period;
    return j < size ? j : period - 1 - j;
}

} // namespace

float srgb_to_linear(uint8_t code) {
    const double c = code / 255.0;
    return float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

TextureMap::TextureMap(const Texture& texture, const TexelImage& image)
    : image_(image), wrap_u_(texture.wrap_u), wrap_v_(texture.wrap_v) {
    for (size_t i = 0; i < 256; ++i)
        decode_[i] = texture.srgb ? srgb_to_linear(uint8_t(i)) : float(i) / 255.0f;
}

glm::vec3 TextureMap::texel(int x, int y) const {
    const uint8_t* rgba = &image_.rgba[4 * (size_t(y) * image_.width + size_t(x))];
    return {decode_[rgba[0]], decode_[rgba[1]], decode_[rgba[2]]};
}

glm::vec3 TextureMap::sample(const glm::vec2& uv) const {
    const int width = int(image_.width), height = int(image_.height);
    const glm::vec2 p(uv.x * float(width) - 0.5f, uv.y * float(height) - 0.5f);
    const glm::vec2 low = glm::floor(p), t = p - low;
    const int x0 = wrapped(int(low.x), width, wrap_u_);
    const int x1 = wrapped(int(low.x) + 1, width, wrap_u_);
    const int y0 = wrapped(int(low.y), height, wrap_v_);
    const int y1 = wrapped(int(low.y) + 1, height, wrap_v_);
    return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), t.x),
                    glm::mix(texel(x0, y1), texel(x1, y1), t.x), t.y);
}

glm::vec3 TextureMap::mean() const {
    glm::dvec3 sum(0.0);
    for (uint32_t y = 0; y < image_.height; ++y)
        for (uint32_t x = 0; x < image_.width; ++x) sum += glm::dvec3(texel(int(x), int(y)));
    return glm::vec3(sum / (double(image_.width) * double(image_.height)));
}

} // namespace onde::reference
