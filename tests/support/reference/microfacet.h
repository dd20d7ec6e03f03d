// GGX microfacets in the local frame of the shading normal (z), isotropic, alpha >= SMOOTH_ALPHA.
#pragma once

#include "support/reference/sampling.h"

namespace onde::reference {

constexpr float SMOOTH_ALPHA = 1e-3f;  ///< what has less is a mirror
constexpr float EQUAL_INDICES = 1e-4f; ///< relative indices so near to 1 do not refract

/// D (Walter et al. 2007, equation 33), written so that nothing cancels near the normal.
inline float ggx_distribution(const glm::vec3& h, float alpha) {
    const float a2 = alpha * alpha;
    const float t = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
    return a2 / (PI * t * t);
}

/// Smith's G1 (Walter et al. 2007, equation 34) for a direction of cosine |z|.
inline float smith_g1(float z, float alpha) {
    const float cosine = std::abs(z), a2 = alpha * alpha;
    return 2.0f * cosine / (cosine + std::sqrt(a2 + (1.0f - a2) * cosine * cosine));
}

/// Smith's Lambda (Heitz 2014, equation 72): G1 = 1 / (1 + Lambda).
inline float smith_lambda(float z, float alpha) {
    return 1.0f / smith_g1(z, alpha) - 1.0f;
}

/// Height-correlated G2 / (4 cos cos) (glTF 2.0, appendix B.3.3; Heitz 2014).
inline float smith_visibility(float z_i, float z_o, float alpha) {
    const float a2 = alpha * alpha;
    return 0.5f / (z_i * std::sqrt(a2 + (1.0f - a2) * z_o * z_o) +
                   z_o * std::sqrt(a2 + (1.0f - a2) * z_i * z_i));
}

/// A normal visible from wo, wo.z > 0 (Heitz 2018, in the form of Dupuy and Benyoub 2023).
inline glm::vec3 sample_visible_normal(const glm::vec3& wo, float alpha, const glm::vec2& u) {
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * wo.x, alpha * wo.y, wo.z));
    const glm::vec3 cap = direction_at(1.0f - u.x * (1.0f + stretched.z), u.y);
    const glm::vec3 h = cap + stretched;
    return glm::normalize(glm::vec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-7f)));
}

/// Density of sample_visible_normal over h: G1 D max(0, wo.h) / cos.
inline float visible_normal_pdf(const glm::vec3& wo, const glm::vec3& h, float alpha) {
    return smith_g1(wo.z, alpha) * ggx_distribution(h, alpha) * std::max(glm::dot(wo, h), 0.0f) /
           wo.z;
}

/// Schlick's weight (1 - cos)^5 (Schlick 1994).
inline float schlick_weight(float cosine) {
    const float x = glm::clamp(1.0f - cosine, 0.0f, 1.0f), x2 = x * x;
    return x2 * x2 * x;
}

/// Unpolarised reflectance of a smooth boundary; eta is the index beyond over the index here.
inline float fresnel_dielectric(float cosine, float eta) {
    const float sine2 = (1.0f - cosine * cosine) / (eta * eta);
    if (sine2 >= 1.0f) return 1.0f;
    const float beyond = std::sqrt(1.0f - sine2);
    const float parallel = (eta * cosine - beyond) / (eta * cosine + beyond);
    const float perpendicular = (cosine - eta * beyond) / (cosine + eta * beyond);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

} // namespace onde::reference
