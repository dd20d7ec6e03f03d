// Glass: reflection and refraction at a GGX-rough or smooth boundary (Walter et al. 2007).
// Radiance is scaled by 1 / eta^2 where it is refracted.
#ifndef ONDE_SHADE_LOBES_DIELECTRIC_H
#define ONDE_SHADE_LOBES_DIELECTRIC_H

#include "shade/lobes/lobe.h"
#include "shade/microfacet.h"

typedef struct {
    real3 tint; // of what goes through
    real alpha;
    real eta; // index below over index above
} DielectricLobe;

// However rough, a boundary of equal indices turns no light around.
#define EQUAL_INDICES 1e-4f

INLINE DielectricLobe dielectric_load(SceneView view, MaterialPoint m) {
    DielectricLobe lobe;
    lobe.tint = m.color;
    const real ior = RECORD(view.materials, m.material, MaterialRecord, ior);
    lobe.alpha = choose(fabs(ior - 1.0f) < EQUAL_INDICES, (real)(0.0f), m.alpha);
    lobe.eta = choose(m.front, ior, 1.0f / ior);
    return lobe;
}
INLINE real dielectric_weight(DielectricLobe lobe, real cosine) {
    return (real)(1.0f);
}

// Refracts wo about h (dot(wo, h) >= 0); meaningless under total internal reflection.
INLINE real3 refract_about(real3 wo, real3 h, real eta) {
    const real cosine = dot3(wo, h);
    const real sine2 = max_real(1.0f - cosine * cosine, (real)(0.0f)) / (eta * eta);
    const real refracted = safe_sqrt(1.0f - sine2);
    const real inverse = 1.0f / eta;
    return madd3(h, fma(cosine, inverse, -refracted), scale3(wo, -inverse));
}

// A rough boundary between wo and wi.
typedef struct {
    real3 h;
    real out, in; // cosines with h
    real fresnel;
    real jacobian; // of refraction, from solid angles of wi to those of h
    mask below;    // wi is
    mask possible;
} Boundary;

INLINE Boundary boundary_between(DielectricLobe lobe, real3 wo, real3 wi) {
    Boundary b;
    b.below = wi.z < 0.0f;
    b.h = normalize3(madd3(wi, choose(b.below, lobe.eta, (real)(1.0f)), wo));
    b.h = choose(b.h.z < 0.0f, negate3(b.h), b.h);
    b.out = dot3(wo, b.h);
    b.in = dot3(wi, b.h);
    b.fresnel = fresnel_dielectric(max_real(b.out, (real)(0.0f)), lobe.eta);
    // Walter's denominator, in units of the transmitted index.
    const real spread = b.in + b.out / lobe.eta;
    b.jacobian = fabs(b.in) / (spread * spread);
    b.possible = (b.out > 0.0f) & (choose(b.below, -b.in, b.in) > 0.0f) & (wi.z != 0.0f);
    return b;
}
INLINE mask dielectric_is_smooth(DielectricLobe lobe) {
    return lobe.alpha < SMOOTH_ALPHA;
}

INLINE LobeValue dielectric_eval(DielectricLobe lobe, real3 wo, real3 wi, mask lanes) {
    const mask rough = lanes & (lobe.alpha >= SMOOTH_ALPHA);
    LobeValue v = no_lobe_value();
    if (!mask_bits(rough)) return v;
    const Boundary b = boundary_between(lobe, wo, wi);
    const mask possible = rough & b.possible;
    const real body =
        ggx_distribution(b.h, lobe.alpha) * ggx_masking_shadowing(wo, wi, lobe.alpha) / wo.z;
    const real refracted = (1.0f - b.fresnel) * body * b.out * b.jacobian;
    const real3 tint = choose(b.below, lobe.tint, splat3((real)(1.0f)));
    v.tint = choose(possible, tint, v.tint);
    v.value = splat3(choose(b.below, refracted / (lobe.eta * lobe.eta), b.fresnel * body * 0.25f));
    v.value = choose(possible, v.value, zero3());

    const real visible = pdf_visible_normal(wo, b.h, lobe.alpha);
    const real mirrored = b.fresnel * visible / (4.0f * max_real(b.out, (real)(1e-9f)));
    const real pdf = choose(b.below, (1.0f - b.fresnel) * visible * b.jacobian, mirrored);
    v.pdf = choose(possible, pdf, v.pdf);
    return v;
}

// Reflects with the Fresnel probability, else refracts, about a visible normal (the macroscopic
// one when alpha is smooth).
INLINE LobeSample dielectric_sample(DielectricLobe lobe, real3 wo, real choice, real2 u) {
    LobeSample s;
    s.delta = lobe.alpha < SMOOTH_ALPHA;
    real3 h = sample_visible_normal(wo, max_real(lobe.alpha, (real)(SMOOTH_ALPHA)), u);
    h = choose(s.delta, make3((real)(0.0f), (real)(0.0f), (real)(1.0f)), h);
    const real fresnel = fresnel_dielectric(max_real(dot3(wo, h), (real)(0.0f)), lobe.eta);
    const mask refracted = choice >= fresnel;
    s.wi = choose(refracted, refract_about(wo, h, lobe.eta), reflect_about(wo, h));
    const real3 tint = scale3(lobe.tint, 1.0f / (lobe.eta * lobe.eta));
    s.weight = choose(refracted, tint, splat3((real)(1.0f)));
    s.valid = choose(refracted, -s.wi.z, s.wi.z) > 0.0f;
    return s;
}

#endif
