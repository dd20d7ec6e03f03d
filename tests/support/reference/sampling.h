// Frames and the elementary distributions. All u are uniform in [0, 1).
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace onde::reference {

inline constexpr float PI = 3.14159265358979f;

inline float luminance(const glm::vec3& c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}
inline float max_component(const glm::vec3& c) {
    return std::max({c.x, c.y, c.z});
}
inline float safe_sqrt(float x) {
    return std::sqrt(std::max(x, 0.0f));
}

/// An orthonormal basis around a unit z (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
struct Frame {
    glm::vec3 x, y, z;

    explicit Frame(const glm::vec3& n) : z(n) {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        x = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
        y = {b, sign + n.y * n.y * a, -n.y};
    }
    glm::vec3 to_local(const glm::vec3& v) const {
        return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
    }
    glm::vec3 to_world(const glm::vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

inline glm::vec2 sample_disk(const glm::vec2& u) {
    const float r = std::sqrt(u.x);
    const float phi = 2.0f * PI * u.y;
    return {r * std::cos(phi), r * std::sin(phi)};
}

/// pdf = z / pi.
inline glm::vec3 sample_cosine_hemisphere(const glm::vec2& u) {
    const glm::vec2 d = sample_disk(u);
    return {d, safe_sqrt(1.0f - d.x * d.x - d.y * d.y)};
}

/// A direction of the given z and an azimuth of 2 pi u.
inline glm::vec3 direction_at(float z, float u) {
    const float r = safe_sqrt(1.0f - z * z);
    return {r * std::cos(2.0f * PI * u), r * std::sin(2.0f * PI * u), z};
}

/// pdf = 1 / (4 pi).
inline glm::vec3 sample_sphere(const glm::vec2& u) {
    return direction_at(1.0f - 2.0f * u.x, u.y);
}

/// Barycentrics of the second and third corner, uniform by area.
inline glm::vec2 sample_triangle(const glm::vec2& u) {
    const float s = std::sqrt(u.x);
    return {s * (1.0f - u.y), s * u.y};
}

/// Weight of a sample from `a` against `b`, both in one measure (Veach 1997, section 9.2.4, beta
/// 2).
inline float power_heuristic(float a, float b) {
    if (a == 0.0f) return 0.0f;
    const float ratio = b / a;
    return 1.0f / (1.0f + ratio * ratio);
}

} // namespace onde::reference
