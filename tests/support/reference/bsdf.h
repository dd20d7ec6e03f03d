// The scattering of light at one point: eval, pdf and sample. Pure values, no scene.
#pragma once

#include "support/reference/material.h"
#include "support/reference/random.h"
#include "support/reference/sampling.h"

#include <optional>

namespace onde::reference {

/// f times |cosine|, and the density of sampling that direction, per solid angle. Delta lobes
/// have no part in either.
struct Scattering {
    glm::vec3 value{0.0f};
    float pdf = 0.0f;
};

struct ScatteringSample {
    glm::vec3 direction; ///< unit, world
    glm::vec3 weight;    ///< f |cosine| / pdf
    float pdf;           ///< of all smooth lobes together; unused when specular
    bool specular;       ///< drawn from a delta lobe
};

/// Radiance transport toward `wo`. Opaque surfaces reflect alike on both sides; no direction
/// passes through them, by the geometric or by the shading normal.
class Bsdf {
  public:
    /// `material` has its textures applied; `normal` is the shading normal, on the front side;
    /// `wo` is unit and points to the viewer. Where the surface `bulges`, directions above the
    /// shading normal are on the viewer's side though they be below the surface.
    Bsdf(const MaterialRecord& material, const glm::vec3& geometric_normal, const glm::vec3& normal,
         const glm::vec3& wo, bool bulges = false);

    /// Whether eval can be other than zero: light sampling is worth a ray.
    bool has_smooth_lobe() const {
        return transparent_ ? !delta_ : !delta_ || specular_pmf_ < 1.0f;
    }
    /// Whether that direction leaves the curved surface, though not the triangle.
    bool leaves_curve(const glm::vec3& wi) const;
    glm::vec3 geometric_normal() const { return geometric_normal_; } ///< on the viewer's side
    Scattering eval(const glm::vec3& wi) const;
    /// Nothing when the light is absorbed.
    std::optional<ScatteringSample> sample(Random& random) const;

  private:
    Scattering eval_opaque(const glm::vec3& wi) const;
    Scattering eval_boundary(const glm::vec3& wi) const;
    Scattering eval_transparent(const glm::vec3& wi) const;
    glm::vec3 sample_opaque(Random& random, bool specular) const;
    glm::vec3 fresnel(float cosine) const;
    std::optional<ScatteringSample> sample_transparent(Random& random) const;
    std::optional<ScatteringSample> smooth_sample(const glm::vec3& wi) const;
    bool same_side(const glm::vec3& wi, const glm::vec3& wi_local) const;
    void set_opaque(const MaterialRecord& material);
    void set_transparent(const MaterialRecord& material);
    glm::vec2 lost_of(const glm::vec2& albedos) const;

    glm::vec3 geometric_normal_; ///< on the viewer's side
    Frame frame_;                ///< its z is the shading normal, on the viewer's side
    glm::vec3 wo_;               ///< local
    Albedos albedos_;
    float alpha_;
    bool delta_;
    bool transparent_;
    bool bulges_;

    // Opaque materials.
    glm::vec3 f0_{0.0f}, f90_{0.0f}; ///< times what brings back the light lost among microfacets
    glm::vec3 body_{0.0f};           ///< its reflectance, times what its coat leaves to it
    float specular_pmf_ = 0.0f;      ///< of choosing the specular lobe

    // Glass.
    glm::vec3 tint_{1.0f};
    float eta_ = 1.0f; ///< index on the other side over index on the viewer's side
    bool entering_ = true;
    float lost_ = 0.0f;         ///< between microfacets, of light along wo
    float below_ = 0.0f;        ///< the part of that which leaves to the other side
    glm::vec2 mean_lost_{1.0f}; ///< of light from the viewer's side and from the other
};

} // namespace onde::reference
