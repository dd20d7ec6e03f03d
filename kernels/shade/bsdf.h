// A surface's BSDF as numbers, and the choice among its lobes. Local directions: the shading
// normal is +z, wo is above. Opaque surfaces are a diffuse lobe under a glossy one (glTF 2.0,
// appendix B); a diffuse material has no glossy lobe, a conductor no diffuse one. Glass is apart.
#ifndef ONDE_SHADE_BSDF_H
#define ONDE_SHADE_BSDF_H

#include "shade/lobes/dielectric.h"
#include "shade/lobes/diffuse.h"

// Compile-time: whether any material of the scene is glass.
#ifndef ONDE_DIELECTRICS
    #define ONDE_DIELECTRICS 1
#endif

typedef struct {
    real3 diffuse; // albedo of the diffuse lobe; glass: tint of what goes through
    real3 f0;      // reflectance of the glossy lobe at normal incidence
    real f90;      // and at grazing: 0 switches the lobe off
    real alpha;
    real glossy; // probability of choosing the glossy lobe
    real eta;    // glass: index below over index above
    mask dielectric;
} Bsdf;

typedef struct {
    real3 value; // BSDF times cosine
    real pdf;
} BsdfValue;

typedef struct {
    real3 wi;
    real3 weight; // BSDF times cosine over pdf
    real pdf;     // 0 after a delta lobe
    mask delta;
    mask valid;
} BsdfSample;

INLINE BsdfValue opaque_eval(Bsdf b, real3 wo, real3 wi) {
    const real3 h = normalize3(add3(wo, wi));
    const real3 fresnel = fresnel_schlick(b.f0, b.f90, dot3(wo, h));
    const real3 through = make3(1.0f - fresnel.x, 1.0f - fresnel.y, 1.0f - fresnel.z);
    BsdfValue v;
    v.value = mul3(through, diffuse_eval(b.diffuse, wi));
    v.pdf = (1.0f - b.glossy) * diffuse_pdf(wi);
    const mask rough = (b.glossy > 0.0f) & (b.alpha >= SMOOTH_ALPHA);
    if_any (rough) {
        const real3 sum = madd3(fresnel, glossy_eval(wo, wi, h, b.alpha), v.value);
        v.value = choose(rough, sum, v.value);
        v.pdf = choose(rough, fma(b.glossy, glossy_pdf(wo, h, b.alpha), v.pdf), v.pdf);
    }
    const mask above = wi.z > 0.0f;
    v.value = choose(above, v.value, zero3());
    v.pdf = choose(above, v.pdf, (real)(0.0f));
    return v;
}

INLINE BsdfValue glass_eval(Bsdf b, real3 wo, real3 wi) {
    const mask rough = b.alpha >= SMOOTH_ALPHA;
    const DielectricValue d = dielectric_eval(wo, wi, b.alpha, b.eta);
    BsdfValue v;
    v.value = madd3(b.diffuse, d.transmitted, splat3(d.reflected));
    v.value = choose(rough, v.value, zero3());
    v.pdf = choose(rough, d.pdf, (real)(0.0f));
    return v;
}

// Delta lobes are left out: their value and pdf are zero here.
INLINE BsdfValue bsdf_eval(Bsdf b, real3 wo, real3 wi) {
    BsdfValue v = opaque_eval(b, wo, wi);
#if ONDE_DIELECTRICS
    if_any (b.dielectric) {
        const BsdfValue glass = glass_eval(b, wo, wi);
        v.value = choose(b.dielectric, glass.value, v.value);
        v.pdf = choose(b.dielectric, glass.pdf, v.pdf);
    }
#endif
    return v;
}

INLINE BsdfSample opaque_sample(Bsdf b, real3 wo, real choice, real2 u) {
    const mask glossy = choice < b.glossy;
    const mask delta = glossy & (b.alpha < SMOOTH_ALPHA);
    BsdfSample s;
    s.wi = diffuse_sample(u);
    if_any (glossy) {
        real3 wi = glossy_sample(wo, max_real(b.alpha, (real)(SMOOTH_ALPHA)), u);
        wi = choose(delta, make3(-wo.x, -wo.y, wo.z), wi);
        s.wi = choose(glossy, wi, s.wi);
    }
    const BsdfValue v = opaque_eval(b, wo, s.wi);
    const real3 mirrored =
        scale3(fresnel_schlick(b.f0, b.f90, wo.z), 1.0f / max_real(b.glossy, (real)(1e-9f)));
    s.weight = choose(delta, mirrored, scale3(v.value, 1.0f / max_real(v.pdf, (real)(1e-30f))));
    s.pdf = choose(delta, (real)(0.0f), v.pdf);
    s.delta = delta;
    s.valid = (s.wi.z > 0.0f) & (delta | (v.pdf > 0.0f));
    return s;
}

INLINE BsdfSample glass_sample(Bsdf b, real3 wo, real choice, real2 u) {
    const DielectricSample d = dielectric_sample(wo, b.alpha, b.eta, choice, u);
    const BsdfValue v = glass_eval(b, wo, d.wi);
    const real3 tint = scale3(b.diffuse, 1.0f / (b.eta * b.eta));
    BsdfSample s;
    s.wi = d.wi;
    s.delta = b.alpha < SMOOTH_ALPHA;
    s.weight = choose(s.delta, choose(d.transmitted, tint, splat3((real)(1.0f))),
                      scale3(v.value, 1.0f / max_real(v.pdf, (real)(1e-30f))));
    s.pdf = choose(s.delta, (real)(0.0f), v.pdf);
    s.valid = choose(d.transmitted, -d.wi.z, d.wi.z) > 0.0f;
    s.valid = s.valid & (s.delta | (v.pdf > 0.0f));
    return s;
}

// choice picks the lobe, u the direction; all in [0, 1).
INLINE BsdfSample bsdf_sample(Bsdf b, real3 wo, real choice, real2 u) {
    BsdfSample s = opaque_sample(b, wo, choice, u);
#if ONDE_DIELECTRICS
    if_any (b.dielectric) {
        const BsdfSample glass = glass_sample(b, wo, choice, u);
        s.wi = choose(b.dielectric, glass.wi, s.wi);
        s.weight = choose(b.dielectric, glass.weight, s.weight);
        s.pdf = choose(b.dielectric, glass.pdf, s.pdf);
        s.delta = choose(b.dielectric, glass.delta, s.delta);
        s.valid = choose(b.dielectric, glass.valid, s.valid);
    }
#endif
    return s;
}

#endif
