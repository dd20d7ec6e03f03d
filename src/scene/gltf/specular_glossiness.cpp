#include "scene/gltf/specular_glossiness.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace onde::gltf {

namespace {

constexpr float DIELECTRIC = 0.04f; ///< reflectance of a surface that is no metal
constexpr float TINY = 1e-6f;

float brightness(const glm::vec3& color) {
    return std::sqrt(glm::dot(color * color, glm::vec3(0.299f, 0.587f, 0.114f)));
}

/// The metallic number m for which a mix of metal and dielectric has that diffuse and specular
/// brightness: the root in 0 to 1 of a quadratic equation.
float solve_metallic(float diffuse, float specular, float not_specular) {
    if (specular <= DIELECTRIC + TINY) return 0.0f;
    const float b = diffuse * not_specular / (1.0f - DIELECTRIC) + specular - 2.0f * DIELECTRIC;
    const float c = DIELECTRIC - specular;
    const float root = std::sqrt(std::max(b * b - 4.0f * DIELECTRIC * c, 0.0f));
    return std::clamp((root - b) / (2.0f * DIELECTRIC), 0.0f, 1.0f);
}

float to_linear(float s) {
    return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

uint8_t to_byte(float value) {
    return uint8_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

uint8_t to_srgb(float value) {
    const float v = std::clamp(value, 0.0f, 1.0f);
    return to_byte(v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f);
}

std::array<float, 256> linear_table() {
    std::array<float, 256> linear;
    for (size_t i = 0; i < linear.size(); ++i) linear[i] = to_linear(float(i) / 255.0f);
    return linear;
}

/// The nearest texel, linear, of an image at a texel of one of another size; white for an empty
/// image.
glm::vec4 texel(const TexelImage& image, size_t x, size_t y, size_t width, size_t height) {
    static const std::array<float, 256> linear = linear_table();
    if (image.empty()) return glm::vec4(1.0f);
    const size_t column = x * image.width / width, row = y * image.height / height;
    const size_t at = 4 * (row * image.width + column);
    if (image.is_linear())
        return {image.floats[at], image.floats[at + 1], image.floats[at + 2], image.floats[at + 3]};
    const uint8_t* rgba = &image.rgba[at];
    return {linear[rgba[0]], linear[rgba[1]], linear[rgba[2]], float(rgba[3]) / 255.0f};
}

} // namespace

MetallicRoughness to_metallic_roughness(const SpecularGlossiness& source) {
    const glm::vec3& specular = source.specular;
    const float not_specular = 1.0f - std::max({specular.r, specular.g, specular.b});
    MetallicRoughness result;
    result.roughness = 1.0f - source.glossiness;
    const float m = solve_metallic(brightness(source.diffuse), brightness(specular), not_specular);
    const glm::vec3 as_dielectric =
        source.diffuse * (not_specular / (1.0f - DIELECTRIC) / std::max(1.0f - m, TINY));
    const glm::vec3 as_metal = (specular - DIELECTRIC * (1.0f - m)) / std::max(m, TINY);
    result.metallic = m;
    result.base_color = glm::clamp(glm::mix(as_dielectric, as_metal, m * m), 0.0f, 1.0f);
    return result;
}

ConvertedTextures convert_textures(const SpecularGlossiness& factors, const TexelImage& diffuse,
                                   const TexelImage& specular) {
    const uint32_t width = std::max({diffuse.width, specular.width, 1u});
    const uint32_t height = std::max({diffuse.height, specular.height, 1u});
    const size_t bytes = 4 * size_t(width) * height;
    ConvertedTextures result{{width, height, std::vector<uint8_t>(bytes)},
                             {width, height, std::vector<uint8_t>(bytes)}};
    for (size_t y = 0, at = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x, at += 4) {
            const glm::vec4 d = texel(diffuse, x, y, width, height);
            const glm::vec4 s = texel(specular, x, y, width, height);
            SpecularGlossiness here;
            here.diffuse = factors.diffuse * glm::vec3(d);
            here.specular = factors.specular * glm::vec3(s);
            here.glossiness = factors.glossiness * s.w;
            const MetallicRoughness converted = to_metallic_roughness(here);
            uint8_t* base = &result.base_color.rgba[at];
            for (size_t c = 0; c < 3; ++c) base[c] = to_srgb(converted.base_color[c]);
            base[3] = to_byte(d.w);
            uint8_t* other = &result.metallic_roughness.rgba[at];
            other[0] = other[3] = 255;
            other[1] = to_byte(converted.roughness);
            other[2] = to_byte(converted.metallic);
        }
    return result;
}

} // namespace onde::gltf
