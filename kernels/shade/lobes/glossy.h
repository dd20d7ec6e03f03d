// Reflection by microfacets: conductors, the specular part of glTF's mix (glTF 2.0, appendix
// B). A mirror where it is smooth. What has met several microfacets leaves as what has met one, so
// that all energy is kept, though not reciprocity.
#ifndef ONDE_SHADE_LOBES_GLOSSY_H
#define ONDE_SHADE_LOBES_GLOSSY_H

#include "shade/facets.h"
#include "shade/lobes/lobe.h"

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
    real3 f0;  // reflectance at normal incidence, times the compensation
    real3 f90; // and at grazing
    GlossyAlpha alpha;
    mask beckmann;
#if ONDE_INNER
    real coat; // of a plastic, as far as it reflects by Fresnel's equations
    real ior;
#endif
#if ONDE_EDGES
    real3 dip; // of metal's, towards the edge
#endif
#if ONDE_IRIDESCENCE
    real iridescence;
    Film film;
#endif
} GlossyLobe;

INLINE mask glossy_is_smooth(GlossyLobe lobe) {
    return WIDEST_ALPHA(lobe.alpha) < SMOOTH_ALPHA;
}
#if ONDE_EDGES
// What a metal whose edge has a tint reflects less than by Schlick's formula, over mu (1 - mu)^6,
// mu being the cosine: by the tint where that is 1/7 (Kutz, Hasan and Edmondson, "Novel aspects of
// the Adobe Standard Material", 2021).
INLINE real3 edge_dip(SceneView view, MaterialPoint m) {
    const real3 tint = RECORD3(view.materials, m.material, MaterialRecord, edge_tint);
    const real3 schlick = fresnel_schlick(m.color, splat3((real)(1.0f)), (real)(1.0f / 7.0f));
    return scale3(mul3(schlick, sub3(splat3((real)(1.0f)), tint)), (real)(17.651476f));
}
#endif
INLINE GlossyLobe glossy_load(SceneView view, MaterialPoint m) {
    const mask mixed = is_of_kind(m, MATERIAL_METALLIC_ROUGHNESS);
    const real metallic = choose(mixed, m.metallic, (real)(1.0f));
    const real3 metal = scale3(compensation(m.albedo, m.color), metallic);
    // The clear part has its own reflection.
    const real3 coat = scale3(compensation(m.albedo, m.f0), opaque_share(m, metallic));
    GlossyLobe lobe;
    lobe.f0 = fma3(m.color, metal, mul3(m.f0, coat));
    lobe.f90 = madd3(coat, m.f90, metal);
    lobe.beckmann = m.beckmann;
#if ONDE_INNER
    lobe.coat = m.exact * m.f90 * opaque_share(m, metallic);
    lobe.ior = m.ior;
#endif
#if ONDE_EDGES
    lobe.dip = mul3(metal, edge_dip(view, m));
#endif
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
    real3 plain = fresnel_schlick(lobe.f0, lobe.f90, cosine);
#if ONDE_INNER
    if_any (lobe.coat > 0.0f) {
        const real beyond = lobe.coat * beyond_schlick(cosine, lobe.ior);
        plain = add3(plain, splat3(choose(lobe.coat > 0.0f, beyond, (real)(0.0f))));
    }
#endif
#if ONDE_EDGES
    const real less = clamp_real(1.0f - cosine, 0.0f, 1.0f);
    plain = madd3(lobe.dip, -cosine * schlick_weight(cosine) * less, plain);
    plain = make3(max_real(plain.x, (real)(0.0f)), max_real(plain.y, (real)(0.0f)),
                  max_real(plain.z, (real)(0.0f)));
#endif
#if ONDE_IRIDESCENCE
    const real least = (real)(1e-6f);
    const real3 whole = make3(max_real(lobe.f90.x, least), max_real(lobe.f90.y, least),
                              max_real(lobe.f90.z, least));
    const real3 f0 = make3(lobe.f0.x / whole.x, lobe.f0.y / whole.y, lobe.f0.z / whole.z);
    const real3 film = film_fresnel(lobe.film, f0, cosine);
    return mix3(plain, mul3(film, whole), lobe.iridescence);
#else
    return plain;
#endif
}
// Not 0 for black metals, which reflect at grazing angles.
INLINE real glossy_weight(GlossyLobe lobe, MaterialPoint m) {
    real reflected = schlick_albedo(m.albedo, luminance3(lobe.f0), luminance3(lobe.f90));
#if ONDE_IRIDESCENCE // a film may reflect many times as much
    const real film = luminance3(glossy_fresnel(lobe, m.cosine)) * m.albedo.white;
    reflected = choose(lobe.iridescence > 0.0f, film, reflected);
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
        const real d = facet_distribution(h, lobe.alpha, lobe.beckmann);
        const real g = facet_masking_shadowing(wo, wi, lobe.alpha, lobe.beckmann);
        const real visible = facet_masking(wo, lobe.alpha, lobe.beckmann) * d;
        v.tint = choose(seen, glossy_fresnel(lobe, dot3(wo, h)), v.tint);
        v.value = choose(seen, splat3(d * g / (4.0f * wo.z)), v.value);
        v.pdf = choose(seen, visible / (4.0f * wo.z), v.pdf);
    }
    return v;
}
INLINE LobeSample glossy_sample(GlossyLobe lobe, real3 wo, real choice, real2 u) {
    const real3 h = sample_facet(wo, rough_alpha(lobe.alpha), lobe.beckmann, u);
    LobeSample s;
    s.delta = glossy_is_smooth(lobe);
    s.wi = choose(s.delta, make3(-wo.x, -wo.y, wo.z), reflect_about(wo, h));
    s.weight = glossy_fresnel(lobe, wo.z);
    s.valid = s.wi.z > 0.0f;
    return s;
}

#endif
