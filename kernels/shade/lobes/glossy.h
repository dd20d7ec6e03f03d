// Reflection by GGX microfacets: conductors, the specular part of glTF's mix (glTF 2.0, appendix
// B). A mirror where it is smooth. What leaves the microfacets only after it has met several of
// them is a matter of the diffuse lobe.
#ifndef ONDE_SHADE_LOBES_GLOSSY_H
#define ONDE_SHADE_LOBES_GLOSSY_H

#include "shade/lobes/lobe.h"
#include "shade/microfacet.h"

#if ONDE_ANISOTROPY
typedef real2 GlossyAlpha;
    #define WIDEST_ALPHA(alpha) (alpha).x
#else
typedef real GlossyAlpha;
    #define WIDEST_ALPHA(alpha) (alpha)
#endif

// What microfacets are sampled by, whether there are any or not.
INLINE GlossyAlpha rough_alpha(GlossyAlpha alpha) {
#if ONDE_ANISOTROPY
    return make2(max_real(alpha.x, (real)(SMOOTH_ALPHA)), max_real(alpha.y, (real)(SMOOTH_ALPHA)));
#else
    return max_real(alpha, (real)(SMOOTH_ALPHA));
#endif
}

typedef struct {
    real3 f0; // reflectance at normal incidence
    real f90; // and at grazing
    GlossyAlpha alpha;
#if ONDE_IRIDESCENCE
    real iridescence;
    Film film;
#endif
} GlossyLobe;

INLINE mask glossy_is_smooth(GlossyLobe lobe) {
    return WIDEST_ALPHA(lobe.alpha) < SMOOTH_ALPHA;
}
INLINE GlossyLobe glossy_load(SceneView view, MaterialPoint m) {
    const real metallic = choose(is_of_kind(m, MATERIAL_CONDUCTOR), (real)(1.0f), m.metallic);
    GlossyLobe lobe;
    const real opaque = opaque_share(m, metallic); // the clear part has its own reflection
    lobe.f0 = madd3(m.color, metallic, scale3(m.f0, opaque));
    lobe.f90 = fma(m.f90, opaque, metallic);
#if ONDE_ANISOTROPY
    lobe.alpha = m.grain;
#else
    lobe.alpha = m.alpha;
#endif
#if ONDE_IRIDESCENCE
    lobe.iridescence = m.iridescence;
    lobe.film = m.film;
#endif
    return lobe;
}
INLINE real3 glossy_fresnel(GlossyLobe lobe, real cosine) {
    const real3 plain = fresnel_schlick(lobe.f0, lobe.f90, cosine);
#if ONDE_IRIDESCENCE
    const real whole = max_real(lobe.f90, (real)(1e-6f));
    const real3 film = film_fresnel(lobe.film, scale3(lobe.f0, 1.0f / whole), cosine);
    return mix3(plain, scale3(film, whole), lobe.iridescence);
#else
    return plain;
#endif
}
// Not 0 for black metals, which reflect at grazing angles.
INLINE real glossy_weight(GlossyLobe lobe, MaterialPoint m) {
    real reflected = luminance3(glossy_fresnel(lobe, m.cosine));
#if ONDE_ALBEDOS
    const real rough = schlick_albedo(m.albedo, luminance3(lobe.f0), lobe.f90);
    reflected = choose(glossy_is_smooth(lobe), reflected, rough);
#endif
    return max_real(reflected, (real)(1e-9f));
}
// Fresnel's factor, and D G / (4 cos_o cos_i) times cos_i.
INLINE LobeValue glossy_eval(GlossyLobe lobe, real3 wo, real3 wi, mask lanes) {
    const mask seen = lanes & !glossy_is_smooth(lobe) & (wi.z > 0.0f);
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
    const real3 h = sample_visible_normal(wo, rough_alpha(lobe.alpha), u);
    LobeSample s;
    s.delta = glossy_is_smooth(lobe);
    s.wi = choose(s.delta, make3(-wo.x, -wo.y, wo.z), reflect_about(wo, h));
    s.weight = glossy_fresnel(lobe, wo.z);
    s.valid = s.wi.z > 0.0f;
    return s;
}

#endif
