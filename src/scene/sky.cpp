#include "scene/sky.h"

#include "scene/load.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace onde {
namespace {

constexpr double PI = std::numbers::pi;

glm::dvec2 equirectangular_uv(const glm::dvec3& d) {
    return {0.5 + std::atan2(d.x, -d.z) / (2.0 * PI), std::acos(std::clamp(d.y, -1.0, 1.0)) / PI};
}

glm::dvec3 direction_of(double u, double v) {
    const double azimuth = 2.0 * PI * (u - 0.5), polar = PI * v;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar),
            -std::sin(polar) * std::cos(azimuth)};
}

/// The angle of a turn about +Y, counter-clockwise seen from above; nothing for other turns.
std::optional<double> upright_angle(const glm::dmat3& turn) {
    constexpr double TOLERANCE = 1e-6;
    if (std::abs(turn[1].y - 1.0) > TOLERANCE || glm::determinant(turn) < 0.0) return std::nullopt;
    return std::atan2(-turn[0].z, turn[0].x);
}

glm::dvec3 radiance_toward(const SkyLight& light, const glm::dvec3& direction) {
    const glm::dvec3 local = direction * light.light_to_world; // the transpose of a turn undoes it
    const glm::dvec2 uv =
        light.shape == SkyShape::octahedral ? octahedral_uv(local) : equirectangular_uv(local);
    return glm::dvec3(light.radiance) * glm::dvec3(pixel_at(light.picture, uv));
}

/// As wide as the widest picture's pixels ask for.
Image empty_map(const std::vector<SkyLight>& lights, LoadContext& context,
                const std::string& name) {
    constexpr uint32_t WIDEST = 8192;
    uint32_t width = 4;
    for (const SkyLight& light : lights)
        width = std::max(width, light.shape == SkyShape::octahedral ? 2 * light.picture.width
                                                                    : light.picture.width);
    width = std::min(width, WIDEST);
    context.spend(uint64_t(width) * (width / 2), ENVIRONMENT_PIXEL_BYTES, name);
    return Image(width, width / 2, 3);
}

/// What the lights add up to in a part of the map, the mean of a grid of directions in it.
glm::dvec3 mean_radiance(const std::vector<SkyLight>& lights, const Image& map, uint32_t x,
                         uint32_t y) {
    constexpr int SIDE = 4; // of the grid
    glm::dvec3 sum(0.0);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const double u = (x + (i % SIDE + 0.5) / SIDE) / map.width;
        const double v = (y + (i / SIDE + 0.5) / SIDE) / map.height;
        for (const SkyLight& light : lights) sum += radiance_toward(light, direction_of(u, v));
    }
    return sum / double(SIDE * SIDE);
}

Image drawn_map(const std::vector<SkyLight>& lights, const glm::dvec3& uniform,
                LoadContext& context, const std::string& name) {
    Image map = empty_map(lights, context, name);
    tbb::parallel_for(0u, map.height, [&](uint32_t y) {
        for (uint32_t x = 0; x < map.width; ++x) {
            const glm::dvec3 radiance = uniform + mean_radiance(lights, map, x, y);
            for (glm::length_t c = 0; c < 3; ++c) map.pixel(x, y)[c] = float(radiance[c]);
        }
    });
    return map;
}

} // namespace

// Clarberg, "Fast equal-area mapping of the (hemi)sphere using
// SIMD", 2008.
glm::dvec2 octahedral_uv(const glm::dvec3& d) {
    const glm::dvec3 a = glm::abs(d);
    const double radius = std::sqrt(std::max(1.0 - a.z, 0.0));
    const double turn = std::atan2(a.y, a.x) * 2.0 / PI; // 0 to 1
    glm::dvec2 uv(radius * (1.0 - turn), radius * turn);
    if (d.z < 0.0) uv = glm::dvec2(1.0 - uv.y, 1.0 - uv.x);
    return 0.5 + 0.5 * glm::dvec2(std::copysign(uv.x, d.x), std::copysign(uv.y, d.y));
}

glm::dmat3 turn_of(const glm::dmat3& m) {
    glm::dmat3 turn(1.0);
    const glm::dvec3 x = glm::normalize(m[0]), y = m[1] - x * glm::dot(x, m[1]);
    if (!(glm::length(m[0]) > 0.0) || !(glm::length(y) > 0.0)) return turn;
    turn[0] = x;
    turn[1] = glm::normalize(y);
    turn[2] = glm::cross(turn[0], turn[1]);
    if (glm::determinant(m) < 0.0) turn[2] = -turn[2];
    return turn;
}

glm::vec3 pixel_at(const Image& picture, const glm::dvec2& uv) {
    const auto at = [](double part, uint32_t size) {
        return uint32_t(std::clamp(part * size, 0.0, double(size - 1)));
    };
    const auto pixel = picture.pixel(at(uv.x, picture.width), at(uv.y, picture.height));
    return {pixel[0], pixel[1], pixel[2]};
}

Environment environment_of(std::vector<SkyLight> lights, LoadContext& context,
                           const std::string& name) {
    glm::dvec3 uniform(0.0);
    std::erase_if(lights, [&](const SkyLight& light) {
        if (light.shape == SkyShape::uniform) uniform += glm::dvec3(light.radiance);
        return light.shape == SkyShape::uniform;
    });
    if (lights.empty()) return {.radiance = glm::vec3(uniform), .map = {}};
    for (SkyLight& light : lights) light.light_to_world = turn_of(light.light_to_world);
    const auto angle = upright_angle(lights[0].light_to_world);
    if (lights.size() == 1 && uniform == glm::dvec3(0.0) && angle &&
        lights[0].shape == SkyShape::equirectangular)
        return {.radiance = lights[0].radiance,
                .map = std::move(lights[0].picture),
                .rotation = float(*angle)};
    return {.radiance = glm::vec3(1.0f), .map = drawn_map(lights, uniform, context, name)};
}

} // namespace onde
