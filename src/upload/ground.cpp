#include "upload/ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde {
namespace {

constexpr double PI = std::numbers::pi;

/// Of the upper half of an environment. A row of a map spans equal angles: its share of the
/// horizontal plane's projected solid angle is exact.
glm::dvec3 irradiance(const Environment& environment) {
    if (!environment.map) return PI * glm::dvec3(environment.radiance);
    const Image& map = *environment.map;
    glm::dvec3 sum(0.0);
    const auto sine2 = [&](uint32_t row) {
        const double angle = std::min(PI * row / map.height, 0.5 * PI);
        return std::sin(angle) * std::sin(angle);
    };
    for (uint32_t y = 0; 2 * y < map.height; y++) {
        glm::dvec3 row(0.0);
        for (uint32_t x = 0; x < map.width; x++) {
            const auto pixel = map.pixel(x, y);
            row += glm::dvec3(pixel[0], pixel[1], pixel[2]);
        }
        sum += row * ((sine2(y + 1) - sine2(y)) * PI / map.width);
    }
    return sum * glm::dvec3(environment.radiance);
}

/// Of a directional light, on a plane to which its middle has that cosine, over that on one that
/// faces it.
double tilted_share(const DirectionalLight& light, double cosine) {
    const double half = 0.5 * double(light.angle), sine = std::sqrt(1 - cosine * cosine);
    if (!has_size(light) || cosine >= std::sin(half)) return std::max(cosine, 0.0);
    if (cosine <= -std::sin(half)) return 0.0;
    // By rings about the middle: of a ring at angle a the part between -w and w is above.
    constexpr int RINGS = 4096;
    double sum = 0;
    for (int i = 0; i < RINGS; i++) {
        const double a = half * (i + 0.5) / RINGS, up = cosine * std::cos(a);
        const double across = sine * std::sin(a);
        const double w = std::acos(std::clamp(-up / across, -1.0, 1.0));
        sum += 2 * std::sin(a) * (up * w + across * std::sin(w));
    }
    return sum * half / RINGS / (PI * std::sin(half) * std::sin(half));
}

} // namespace

glm::vec3 ground_share(const Scene& scene) {
    if (!scene.environment.ground) return glm::vec3(0.0f);
    glm::dvec3 sum = irradiance(scene.environment);
    for (const DirectionalLight& light : scene.directional_lights)
        sum += glm::dvec3(light.irradiance) * tilted_share(light, double(light.to_light.y));
    glm::vec3 share(0.0f);
    for (glm::length_t k = 0; k < 3; k++)
        if (sum[k] > 1e-30) share[k] = float(1.0 / sum[k]);
    return share;
}

} // namespace onde
