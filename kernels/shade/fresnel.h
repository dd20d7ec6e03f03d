// How much light a smooth boundary reflects.
#ifndef ONDE_SHADE_FRESNEL_H
#define ONDE_SHADE_FRESNEL_H

#include "math/elementary.h"

// Schlick 1994: the way from normal incidence, 0, to grazing, 1.
INLINE real schlick_weight(real cosine) {
    const real m = clamp_real(1.0f - cosine, 0.0f, 1.0f);
    const real m2 = m * m;
    return m2 * m2 * m;
}
// From f0 at normal incidence to f90 at grazing.
INLINE real3 fresnel_schlick(real3 f0, real3 f90, real cosine) {
    return mix3(f0, f90, schlick_weight(cosine));
}

// Unpolarised Fresnel equations. eta is the index beyond the boundary over the index before it,
// cosine (>= 0) that of the incident direction. 1 beyond the critical angle.
INLINE real fresnel_dielectric(real cosine, real eta) {
    const real sine2 = (1.0f - cosine * cosine) / (eta * eta);
    const real refracted = safe_sqrt(1.0f - sine2);
    const real parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
    const real perpendicular = (cosine - eta * refracted) / (cosine + eta * refracted);
    const real f = 0.5f * fma(parallel, parallel, perpendicular * perpendicular);
    return choose(sine2 >= 1.0f, (real)(1.0f), f);
}

// What they say of an index of refraction beyond what Schlick's formula does.
INLINE real beyond_schlick(real cosine, real ior) {
    const real within = clamp_real(cosine, 0.0f, 1.0f);
    const real f0 = square((ior - 1.0f) / (ior + 1.0f));
    return fresnel_dielectric(within, ior) - fma(1.0f - f0, schlick_weight(within), f0);
}

// The share of diffuse light that a boundary lets through; a fit by d'Eon and Irving, "A Quantized-
// Diffusion Model for Rendering Translucent Materials", 2011. Reciprocal.
INLINE real mean_transmission(real eta) {
    const real thin = max_real(eta, 1.0f / eta);
    const real from_outside = 1.0f - (thin - 1.0f) / fma((real)(1.00071f), thin, (real)(4.08567f));
    return choose(eta < 1.0f, from_outside / (thin * thin), from_outside);
}

#endif
