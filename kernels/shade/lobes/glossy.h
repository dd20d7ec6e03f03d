// Reflection by GGX microfacets: conductors, the specular part of glTF's mix (glTF 2.0, appendix
// B). A mirror where it is smooth. What leaves the microfacets only after it has met several of
// them is a matter of the diffuse lobe.
#ifndef ONDE_SHADE_LOBES_GLOSSY_H
#define ONDE_SHADE_LOBES_GLOSSY_H

#include "shade/lobes/lobe.h"
#include "shade/microfacet.h"

// Reflectance at normal incidence of the dielectric half of glTF's mix (index 1.5).
#define DIELECTRIC_F0 0.04f

typedef struct {
    real3 f0; // reflectance at normal incidence
    real f90; // and at grazing
    real alpha;
} GlossyLobe;

// The reflectance of the coat at normal incidence.
INLINE real coat_f0(SceneView view, MaterialPoint m) {
#if ONDE_INDICES
    const real ior = RECORD(view.materials, m.material, MaterialRecord, ior);
    return square((ior - 1.0f) / (ior + 1.0f));
#else
    return (real)(DIELECTRIC_F0);
#endif
}

INLINE GlossyLobe glossy_load(SceneView view, MaterialPoint m) {
    const real metallic = choose(is_of_kind(m, MATERIAL_CONDUCTOR), (real)(1.0f), m.metallic);
    const real coat = coat_f0(view, m);
    GlossyLobe lobe;
#if ONDE_TRANSMISSION // the clear part has its own reflection
    const real opaque = choose(metallic < 1.0f, opaque_share(m, metallic), (real)(0.0f));
    lobe.f0 = madd3(m.color, metallic, splat3(coat * opaque));
    lobe.f90 = metallic + opaque;
#else
    lobe.f0 = mix3(splat3(coat), m.color, metallic);
    lobe.f90 = (real)(1.0f);
#endif
    lobe.alpha = m.alpha;
    return lobe;
}
INLINE real3 glossy_fresnel(GlossyLobe lobe, real cosine) {
    return fresnel_schlick(lobe.f0, lobe.f90, cosine);
}
// Not 0 for black metals, which reflect at grazing angles.
INLINE real glossy_weight(GlossyLobe lobe, MaterialPoint m) {
#if ONDE_ALBEDOS
    const real reflected = schlick_albedo(m.albedo, luminance3(lobe.f0), lobe.f90);
#else
    const real reflected = luminance3(glossy_fresnel(lobe, m.cosine));
#endif
    return max_real(reflected, (real)(1e-9f));
}
INLINE mask glossy_is_smooth(GlossyLobe lobe) {
    return lobe.alpha < SMOOTH_ALPHA;
}

// Fresnel's factor, and D G / (4 cos_o cos_i) times cos_i.
INLINE LobeValue glossy_eval(GlossyLobe lobe, real3 wo, real3 wi, mask lanes) {
    const mask seen = lanes & (lobe.alpha >= SMOOTH_ALPHA) & (wi.z > 0.0f);
    LobeValue v = no_lobe_value();
    if (!ONDE_ROUGH) return v;
    if_any (seen) {
        const real3 h = half_vector(wo, wi);
        const real d = ggx_distribution(h, lobe.alpha);
        const real g = ggx_masking_shadowing(wo, wi, lobe.alpha);
        const real visible = ggx_masking(wo, lobe.alpha) * d;
        v.tint = choose(seen, glossy_fresnel(lobe, dot3(wo, h)), v.tint);
        v.value = choose(seen, splat3(d * g / (4.0f * wo.z)), v.value);
        v.pdf = choose(seen, visible / (4.0f * wo.z), v.pdf);
    }
    return v;
}
INLINE LobeSample glossy_sample(GlossyLobe lobe, real3 wo, real choice, real2 u) {
    const real3 h = sample_visible_normal(wo, max_real(lobe.alpha, (real)(SMOOTH_ALPHA)), u);
    LobeSample s;
    s.delta = lobe.alpha < SMOOTH_ALPHA;
    s.wi = choose(s.delta, make3(-wo.x, -wo.y, wo.z), reflect_about(wo, h));
    s.weight = glossy_fresnel(lobe, wo.z);
    s.valid = s.wi.z > 0.0f;
    return s;
}

#endif
