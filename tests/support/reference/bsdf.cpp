#include "support/reference/bsdf.h"

namespace onde::reference {
namespace {

constexpr float LEAST_LOSS = 1e-5f; ///< a mean that is divided by
constexpr float MIN_COSINE = 1e-3f; ///< of the viewer to the shading normal

glm::vec3 facing_normal(const glm::vec3& geometric, const glm::vec3& shading, const glm::vec3& wo) {
    const glm::vec3 n = glm::dot(shading, geometric) < 0.0f ? -shading : shading;
    return glm::dot(n, wo) < MIN_COSINE ? geometric : n;
}

/// Keller et al., "The Iray Light Transport Simulation and Rendering System", 2017: the mirror
/// direction is moved above the surface, and the normal is half way to it.
glm::vec3 valid_normal(const glm::vec3& geometric, const glm::vec3& normal, const glm::vec3& wo) {
    const glm::vec3 mirror = 2.0f * glm::dot(wo, normal) * normal - wo;
    const float least = std::min(0.9f * glm::dot(wo, geometric), 0.01f);
    const float height = glm::dot(mirror, geometric);
    if (normal == geometric || height >= least) return normal;
    return glm::normalize(wo + glm::normalize(mirror + (least - height) * geometric));
}

glm::vec3 shading_normal(MaterialKind kind, const glm::vec3& geometric, const glm::vec3& shading,
                         const glm::vec3& wo) {
    const glm::vec3 n = facing_normal(geometric, shading, wo);
    return kind == MaterialKind::diffuse ? n : valid_normal(geometric, n, wo);
}

glm::vec3 mirrored(const glm::vec3& wo, const glm::vec3& h) {
    return 2.0f * glm::dot(wo, h) * h - wo;
}

/// Turquin 2019, "Practical multiple scattering compensation for microfacet models": light that is
/// lost among microfacets of reflectance f0 follows what they reflect at once, f0 times as bright.
glm::vec3 followed(const glm::vec3& f0, float white_albedo) {
    return 1.0f + f0 * (1.0f / white_albedo - 1.0f);
}

/// Snell's law about h, on wo's side; eta is the index beyond over the index here. Not to be
/// called under total reflection.
glm::vec3 refracted(const glm::vec3& wo, const glm::vec3& h, float eta) {
    const float cosine = glm::dot(wo, h);
    const float beyond = safe_sqrt(1.0f - (1.0f - cosine * cosine) / (eta * eta));
    return (cosine / eta - beyond) * h - wo / eta;
}

} // namespace

Bsdf::Bsdf(const MaterialRecord& material, const glm::vec3& geometric_normal,
           const glm::vec3& normal, const glm::vec3& wo, bool bulges)
    : geometric_normal_(glm::dot(geometric_normal, wo) < 0.0f ? -geometric_normal
                                                              : geometric_normal),
      frame_(shading_normal(material.kind, geometric_normal_, normal, wo)),
      wo_(frame_.to_local(wo)), alpha_(material.roughness * material.roughness),
      delta_(alpha_ < SMOOTH_ALPHA), transparent_(material.kind == MaterialKind::dielectric),
      bulges_(bulges) {
    entering_ = glm::dot(geometric_normal, wo) >= 0.0f;
    if (transparent_)
        set_transparent(material);
    else
        set_opaque(material);
}

void Bsdf::set_opaque(const MaterialRecord& material) {
    const glm::vec3& color = material.base_color;
    if (material.kind == MaterialKind::diffuse) {
        body_ = color;
        delta_ = false;
        return;
    }
    const float metallic = material.kind == MaterialKind::conductor ? 1.0f : material.metallic;
    const glm::vec3 coat_f0(0.04f); // of index 1.5 (glTF 2.0, appendix B.2)
    if (!delta_) albedos_ = Albedos(*material.albedos, material.roughness);
    const glm::vec2 albedos = albedos_.at(wo_.z);
    const glm::vec3 metal = metallic * followed(color, albedos.x);
    const glm::vec3 coat = (1.0f - metallic) * followed(coat_f0, albedos.x);
    f0_ = metal * color + coat * coat_f0;
    f90_ = metal + coat;
    // The body has what its coat does not reflect toward the viewer: white is white.
    body_ = color * (1.0f - metallic - coat * (0.04f * albedos.x + 0.96f * albedos.y));
    const float specular = luminance(f0_ * (albedos.x - albedos.y) + f90_ * albedos.y);
    const float diffuse = luminance(body_);
    specular_pmf_ =
        diffuse > 0.0f ? glm::clamp(specular / (specular + diffuse), 0.1f, 0.98f) : 1.0f;
}

void Bsdf::set_transparent(const MaterialRecord& material) {
    tint_ = material.base_color;
    eta_ = entering_ ? material.ior : 1.0f / material.ior;
    // Equal indices do not refract, however rough the boundary.
    delta_ = delta_ || !material.albedos;
    if (delta_) return;
    albedos_ = Albedos(*material.albedos, material.roughness);
    lost_ = lost_of(albedos_.at(wo_.z)).x;
    mean_lost_ = glm::max(lost_of(albedos_.mean()), LEAST_LOSS);
    const float transmission = material.mean_transmission * (entering_ ? 1.0f : eta_ * eta_);
    // As much of it as lets both sides send each other the same.
    below_ = transmission * std::min(mean_lost_.y / mean_lost_.x, 1.0f);
}

/// Of light from the viewer's side and from the other, by albedos from outside and from inside.
glm::vec2 Bsdf::lost_of(const glm::vec2& albedos) const {
    return 1.0f - (entering_ ? albedos : glm::vec2(albedos.y, albedos.x));
}

bool Bsdf::leaves_curve(const glm::vec3& wi) const {
    return bulges_ && glm::dot(wi, geometric_normal_) <= 0.0f && frame_.to_local(wi).z > 0.0f;
}

bool Bsdf::same_side(const glm::vec3& wi, const glm::vec3& wi_local) const {
    return leaves_curve(wi) || (glm::dot(wi, geometric_normal_) > 0.0f) == (wi_local.z > 0.0f);
}

Scattering Bsdf::eval(const glm::vec3& wi) const {
    const glm::vec3 local = frame_.to_local(wi);
    if (!(wo_.z > 0.0f) || local.z == 0.0f || !same_side(wi, local)) return {};
    return transparent_ ? eval_transparent(local) : eval_opaque(local);
}

Scattering Bsdf::eval_opaque(const glm::vec3& wi) const {
    if (wi.z <= 0.0f) return {};
    if (specular_pmf_ == 0.0f) return {body_ * (wi.z / PI), wi.z / PI};
    Scattering s;
    if (specular_pmf_ < 1.0f) {
        s.value = body_ * (wi.z / PI);
        s.pdf = (1.0f - specular_pmf_) * wi.z / PI;
    }
    if (!delta_) {
        const glm::vec3 h = glm::normalize(wi + wo_);
        const float d = ggx_distribution(h, alpha_);
        s.value += fresnel(glm::dot(wo_, h)) * (d * smith_visibility(wi.z, wo_.z, alpha_) * wi.z);
        s.pdf += specular_pmf_ * smith_g1(wo_.z, alpha_) * d / (4.0f * wo_.z);
    }
    return s;
}

glm::vec3 Bsdf::fresnel(float cosine) const {
    return glm::mix(f0_, f90_, schlick_weight(cosine));
}

// Walter et al. 2007, equations 20 and 21, sampled by visible normals. The masking is the
// height-correlated one on both sides, as in pbrt-v4.
Scattering Bsdf::eval_boundary(const glm::vec3& wi) const {
    const bool reflects = wi.z > 0.0f;
    glm::vec3 h = glm::normalize(reflects ? wi + wo_ : wo_ + eta_ * wi);
    if (h.z < 0.0f) h = -h;
    const float o_h = glm::dot(wo_, h), i_h = glm::dot(wi, h);
    if (o_h <= 0.0f || (i_h > 0.0f) != reflects) return {};
    const float reflectance = fresnel_dielectric(o_h, eta_);
    const float visible = visible_normal_pdf(wo_, h, alpha_);
    const float lambda_o = smith_lambda(wo_.z, alpha_), lambda_i = smith_lambda(wi.z, alpha_);
    const float shadowing = (1.0f + lambda_o) / (1.0f + lambda_o + lambda_i); // G2 / G1
    if (reflects) {
        const float pdf = reflectance * visible / (4.0f * o_h);
        return {glm::vec3(pdf * shadowing), pdf};
    }
    const float denominator = o_h + eta_ * i_h;
    const float jacobian = eta_ * eta_ * std::abs(i_h) / (denominator * denominator);
    const float pdf = (1.0f - reflectance) * visible * jacobian;
    return {tint_ * (pdf * shadowing / (eta_ * eta_)), pdf};
}

/// What one microfacet scatters, and what several do: evenly, to both sides, in the spirit of Kulla
/// and Conty 2017.
Scattering Bsdf::eval_transparent(const glm::vec3& wi) const {
    if (delta_) return {};
    Scattering s = eval_boundary(wi);
    const float cosine = std::abs(wi.z);
    const glm::vec2 lost = lost_of(albedos_.at(cosine)) / mean_lost_;
    const float part = wi.z > 0.0f ? 1.0f - below_ : below_;
    const float even = lost_ * part * cosine / PI;
    s.value += wi.z > 0.0f ? glm::vec3(even * lost.x) : tint_ * (even * lost.y / (eta_ * eta_));
    s.pdf = (1.0f - lost_) * s.pdf + even;
    return s;
}

std::optional<ScatteringSample> Bsdf::sample(Random& random) const {
    if (!(wo_.z > 0.0f)) return std::nullopt;
    if (transparent_) return sample_transparent(random);
    const bool specular = random.next() < specular_pmf_;
    if (!specular || !delta_) return smooth_sample(sample_opaque(random, specular));
    const glm::vec3 wi(-wo_.x, -wo_.y, wo_.z);
    const glm::vec3 direction = frame_.to_world(wi);
    if (!same_side(direction, wi)) return std::nullopt;
    return ScatteringSample{direction, fresnel(wo_.z) / specular_pmf_, 0.0f, true};
}

glm::vec3 Bsdf::sample_opaque(Random& random, bool specular) const {
    const glm::vec2 u = random.next2();
    if (!specular) return sample_cosine_hemisphere(u);
    return mirrored(wo_, sample_visible_normal(wo_, alpha_, u));
}

std::optional<ScatteringSample> Bsdf::smooth_sample(const glm::vec3& wi) const {
    const glm::vec3 direction = glm::normalize(frame_.to_world(wi));
    const Scattering s = eval(direction);
    if (!(s.pdf > 0.0f)) return std::nullopt;
    return ScatteringSample{direction, s.value / s.pdf, s.pdf, false};
}

std::optional<ScatteringSample> Bsdf::sample_transparent(Random& random) const {
    if (lost_ > 0.0f && random.next() < lost_) {
        const glm::vec3 even = sample_cosine_hemisphere(random.next2());
        return smooth_sample(random.next() < below_ ? -even : even);
    }
    const glm::vec3 h =
        delta_ ? glm::vec3(0.0f, 0.0f, 1.0f) : sample_visible_normal(wo_, alpha_, random.next2());
    const bool reflects = random.next() < fresnel_dielectric(glm::dot(wo_, h), eta_);
    const glm::vec3 wi = reflects ? mirrored(wo_, h) : refracted(wo_, h, eta_);
    if ((wi.z > 0.0f) != reflects) return std::nullopt;
    if (!delta_) return smooth_sample(wi);
    const glm::vec3 direction = glm::normalize(frame_.to_world(wi));
    if (!same_side(direction, wi)) return std::nullopt;
    const glm::vec3 weight = reflects ? glm::vec3(1.0f) : tint_ / (eta_ * eta_);
    return ScatteringSample{direction, weight, 0.0f, true};
}

} // namespace onde::reference
