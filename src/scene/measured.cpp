#include "scene/measured.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde {

/// Of unpolarized light that meets a dielectric from outside.
static double fresnel(double cosine, double index) {
    const double sine2 = (1.0 - cosine * cosine) / (index * index);
    const double inside = std::sqrt(std::max(1.0 - sine2, 0.0));
    const double s = (cosine - index * inside) / (cosine + index * inside);
    const double p = (inside - index * cosine) / (inside + index * cosine);
    return 0.5 * (s * s + p * p);
}

/// What is sent back outside is 2 F(mu) mu dmu; by reciprocity, what comes out of diffuse light
/// from within is what goes in, over the square of the index.
double internal_reflectance(double index) {
    constexpr int STEPS = 256;
    double outside = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        const double cosine = (i + 0.5) / STEPS;
        outside += 2.0 * cosine * fresnel(cosine, index) / STEPS;
    }
    return 1.0 - (1.0 - outside) / (index * index);
}

static float usable_index(double index) {
    return float(std::clamp(std::isfinite(index) ? index : 1.5, 0.01, 100.0));
}

void set_plastic(Material& material, double index) {
    material.kind = MaterialKind::metallic_roughness;
    material.ior = std::max(usable_index(index), 1.0f);
    material.inner_reflection =
        float(std::clamp(internal_reflectance(double(material.ior)), 0.0, 0.999));
}

void set_pane(Material& material, double index) {
    material.kind = MaterialKind::dielectric;
    material.ior = usable_index(index);
    material.thin_walled = true;
    material.roughness = 0.0f;
}

bool fill(Material& material, const Medium& medium) {
    if (material.alpha_mode == AlphaMode::mask && material.alpha == 0.0f) {
        const std::string name = material.name;
        material = Material{};
        material.name = name;
        material.kind = MaterialKind::dielectric;
        material.base_color = glm::vec3(1.0f);
        material.roughness = 0.0f;
        material.ior = 1.0f;
    }
    const bool mixed =
        material.kind == MaterialKind::metallic_roughness && material.transmission > 0.0f;
    if (material.kind != MaterialKind::dielectric && !mixed) return false;
    material.medium = medium;
    return true;
}

double conductor_reflectance(double cosine, double eta, double k) {
    const double c2 = cosine * cosine, s2 = 1.0 - c2;
    const double real = eta * eta - k * k - s2;
    const double root = std::sqrt(real * real + 4.0 * eta * eta * k * k);
    const double a = std::sqrt(std::max(0.5 * (root + real), 0.0));
    const double s = (root + c2 - 2.0 * a * cosine) / (root + c2 + 2.0 * a * cosine);
    const double left = c2 * root + s2 * s2, right = 2.0 * a * cosine * s2;
    return 0.5 * s * (1.0 + (left - right) / (left + right));
}

double edge_tint(double eta, double k) {
    constexpr double COSINE = 1.0 / 7.0;
    const double normal = conductor_reflectance(1.0, eta, k);
    const double schlick = normal + (1.0 - normal) * std::pow(1.0 - COSINE, 5.0);
    const double tint = conductor_reflectance(COSINE, eta, k) / schlick;
    return std::isfinite(tint) ? std::clamp(tint, 0.0, 1.0) : 1.0;
}

void set_alphas(Material& material, double u, double v) {
    const double less = std::clamp(std::min(u, v), 0.0, 1.0);
    const double more = std::clamp(std::max(u, v), 0.0, 1.0);
    material.roughness = float(std::sqrt(less));
    if (more <= less) return;
    material.anisotropy = float(std::sqrt((more - less) / (1.0 - less)));
    material.anisotropy_rotation = u < v ? 0.5f * std::numbers::pi_v<float> : 0.0f;
}

} // namespace onde
