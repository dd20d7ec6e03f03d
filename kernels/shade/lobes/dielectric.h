// Glass: reflection and refraction at a GGX-rough or smooth boundary (Walter et al. 2007).
// Local directions; wo is above. eta is the index below over the index above. Radiance is
// scaled by 1 / eta^2 where it is refracted.
#ifndef ONDE_SHADE_LOBES_DIELECTRIC_H
#define ONDE_SHADE_LOBES_DIELECTRIC_H

#include "shade/fresnel.h"
#include "shade/lobes/glossy.h"

// Refracts wo about h (dot(wo, h) >= 0); meaningless under total internal reflection.
INLINE real3 refract_about(real3 wo, real3 h, real eta) {
    const real cosine = dot3(wo, h);
    const real sine2 = max_real(1.0f - cosine * cosine, (real)(0.0f)) / (eta * eta);
    const real refracted = safe_sqrt(1.0f - sine2);
    const real inverse = 1.0f / eta;
    return madd3(h, fma(cosine, inverse, -refracted), scale3(wo, -inverse));
}

typedef struct {
    real reflected;   // BSDF times cosine for wi above; 0 elsewhere
    real transmitted; // the same for wi below, without tint
    real pdf;
} DielectricValue;

INLINE DielectricValue dielectric_eval(real3 wo, real3 wi, real alpha, real eta) {
    const mask below = wi.z < 0.0f;
    const real relative = choose(below, eta, (real)(1.0f));
    real3 h = normalize3(madd3(wi, relative, wo));
    h = choose(h.z < 0.0f, negate3(h), h);
    const real out = dot3(wo, h), in = dot3(wi, h);
    const real fresnel = fresnel_dielectric(max_real(out, (real)(0.0f)), eta);
    const real visible = pdf_visible_normal(wo, h, alpha);
    const real body = ggx_distribution(h, alpha) * ggx_masking_shadowing(wo, wi, alpha) / wo.z;
    const real spread = in + out / eta; // Walter's denominator, in units of the transmitted index
    const real jacobian = fabs(in) / (spread * spread);
    const mask possible = (out > 0.0f) & (choose(below, -in, in) > 0.0f) & (wi.z != 0.0f);
    const real zero = (real)(0.0f);
    DielectricValue value;
    value.reflected = choose(possible & !below, fresnel * body * 0.25f, zero);
    value.transmitted =
        choose(possible & below, (1.0f - fresnel) * body * out * jacobian / (eta * eta), zero);
    value.pdf = choose(below, (1.0f - fresnel) * visible * jacobian,
                       fresnel * visible / (4.0f * max_real(out, (real)(1e-9f))));
    value.pdf = choose(possible, value.pdf, zero);
    return value;
}

typedef struct {
    real3 wi;
    real fresnel;
    mask transmitted;
} DielectricSample;

// Reflects with the Fresnel probability, else refracts, about a visible normal (the macroscopic
// one when alpha is smooth).
INLINE DielectricSample dielectric_sample(real3 wo, real alpha, real eta, real choice, real2 u) {
    const mask smooth = alpha < SMOOTH_ALPHA;
    real3 h = sample_visible_normal(wo, max_real(alpha, (real)(SMOOTH_ALPHA)), u);
    h = choose(smooth, make3((real)(0.0f), (real)(0.0f), (real)(1.0f)), h);
    DielectricSample s;
    s.fresnel = fresnel_dielectric(max_real(dot3(wo, h), (real)(0.0f)), eta);
    s.transmitted = choice >= s.fresnel;
    s.wi = choose(s.transmitted, refract_about(wo, h, eta), reflect_about(wo, h));
    return s;
}

#endif
