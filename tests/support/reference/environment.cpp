#include "support/reference/environment.h"

#include "support/reference/sampling.h"

namespace onde::reference {

EnvironmentLight::EnvironmentLight(const Environment& environment)
    : scale_(environment.radiance), turns_(environment.rotation / (2.0f * PI)) {
    if (!environment.map) {
        integral_ = 4.0f * PI * luminance(scale_);
        black_ = max_component(scale_) <= 0.0f;
        return;
    }
    const Image& map = *environment.map;
    width_ = int(map.width), height_ = int(map.height);
    texels_.reserve(size_t(map.width) * map.height);
    for (size_t i = 0; i < size_t(map.width) * map.height; ++i) {
        const float* rgb = &map.pixels[i * map.channels];
        texels_.emplace_back(rgb[0], rgb[1], rgb[2]);
    }
    double total = 0.0;
    std::vector<float> powers;
    powers.reserve(texels_.size());
    for (int y = 0; y < height_; ++y) {
        row_solid_angle_.push_back(pixel_solid_angle(y));
        for (int x = 0; x < width_; ++x) total += powers.emplace_back(pixel_power(x, y));
    }
    pixels_ = AliasTable(powers);
    integral_ = float(total);
    black_ = pixels_.empty();
}

glm::vec3 EnvironmentLight::texel(int x, int y) const {
    const int column = x < 0 ? x + width_ : x >= width_ ? x - width_ : x;
    return texels_[size_t(std::clamp(y, 0, height_ - 1)) * size_t(width_) + size_t(column)];
}

float EnvironmentLight::pixel_solid_angle(int y) const {
    const float rows = float(height_);
    const float height = std::cos(PI * float(y) / rows) - std::cos(PI * float(y + 1) / rows);
    return 2.0f * PI * height / float(width_);
}

// The bilinear interpolant's mean over a pixel weighs itself 3/4 and its neighbours 1/8 per axis.
float EnvironmentLight::pixel_power(int x, int y) const {
    constexpr float WEIGHT[] = {0.125f, 0.75f, 0.125f};
    glm::vec3 mean(0.0f);
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            mean += WEIGHT[dx + 1] * WEIGHT[dy + 1] * texel(x + dx, y + dy);
    return luminance(mean * scale_) * row_solid_angle_[size_t(y)];
}

glm::vec2 EnvironmentLight::to_map(const glm::vec3& d) const {
    const float u = 0.5f + std::atan2(d.x, -d.z) / (2.0f * PI) + turns_;
    return {u - std::floor(u), std::acos(glm::clamp(d.y, -1.0f, 1.0f)) / PI};
}

glm::vec3 EnvironmentLight::radiance(const glm::vec3& direction) const {
    if (texels_.empty()) return scale_;
    const glm::vec2 p = to_map(direction) * glm::vec2(width_, height_) - 0.5f;
    const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
    const float s = p.x - float(x), t = p.y - float(y);
    return scale_ * glm::mix(glm::mix(texel(x, y), texel(x + 1, y), s),
                             glm::mix(texel(x, y + 1), texel(x + 1, y + 1), s), t);
}

EnvironmentLight::Sample EnvironmentLight::sample(Random& random) const {
    const float choice = random.next();
    const glm::vec2 u = random.next2();
    if (pixels_.empty()) return {sample_sphere(u), 1.0f / (4.0f * PI)};
    const AliasTable::Choice pixel = pixels_.sample(choice);
    const auto x = pixel.index % uint32_t(width_), y = pixel.index / uint32_t(width_);
    const float rows = float(height_);
    const float top = std::cos(PI * float(y) / rows), bottom = std::cos(PI * float(y + 1) / rows);
    const float cosine = glm::mix(top, bottom, u.y), sine = safe_sqrt(1.0f - cosine * cosine);
    const float phi = 2.0f * PI * ((float(x) + u.x) / float(width_) - 0.5f - turns_);
    return {{sine * std::sin(phi), cosine, -sine * std::cos(phi)}, pixel.pmf / row_solid_angle_[y]};
}

float EnvironmentLight::pdf(const glm::vec3& direction) const {
    if (pixels_.empty()) return 1.0f / (4.0f * PI);
    const glm::vec2 p = to_map(direction) * glm::vec2(width_, height_);
    const auto x = uint32_t(std::min(int(p.x), width_ - 1));
    const auto y = uint32_t(std::min(int(p.y), height_ - 1));
    return pixels_.pmf(y * uint32_t(width_) + x) / row_solid_angle_[y];
}

} // namespace onde::reference
