// From uniform numbers to points and directions. Every sample_ has its pdf beside it.
#ifndef ONDE_MATH_SAMPLING_H
#define ONDE_MATH_SAMPLING_H

#include "math/elementary.h"

// Uniform on the unit disk.
INLINE real2 sample_disk(real2 u) {
    const real r = sqrt(u.x);
    const SineCosine a = sincos_turns(u.y);
    return make2(r * a.cosine, r * a.sine);
}

// Cosine-weighted about +z; pdf z / pi per solid angle.
INLINE real3 sample_cosine_hemisphere(real2 u) {
    const real2 d = sample_disk(u);
    return make3(d.x, d.y, safe_sqrt(1.0f - u.x));
}
INLINE real pdf_cosine_hemisphere(real cosine) {
    return max_real(cosine, (real)(0.0f)) * INV_PI;
}

// Uniform in the cone about +z whose half angle has 1 - cos = opening; pdf 1 / (2 pi opening).
INLINE real3 sample_cone(real2 u, real opening) {
    const real below = u.x * opening; // 1 - cos, kept small for precision
    const real sine = safe_sqrt(below * (2.0f - below));
    const SineCosine a = sincos_turns(u.y);
    return make3(sine * a.cosine, sine * a.sine, 1.0f - below);
}
INLINE real pdf_cone(real opening) {
    return 0.5f * INV_PI / opening;
}

// Uniform on the unit sphere; pdf 1 / (4 pi).
INLINE real3 sample_sphere(real2 u) {
    return sample_cone(u, (real)(2.0f));
}
#define PDF_SPHERE (0.25f * INV_PI)

// Barycentric weights of corners 1 and 2, uniform over a triangle's area
// (Heitz 2019, A Low-Distortion Map Between Triangle and Square).
INLINE real2 sample_triangle(real2 u) {
    const mask upper = u.y > u.x;
    const real small = choose(upper, u.x, u.y) * 0.5f;
    const real large = choose(upper, u.y, u.x) - small;
    return make2(choose(upper, small, large), choose(upper, large, small));
}

// Distributed as a tent over [-1, 1].
INLINE real sample_tent(real u) {
    const mask rising = u < 0.5f;
    const real side = 1.0f - safe_sqrt(2.0f * choose(rising, u, 1.0f - u));
    return choose(rising, -side, side);
}

// Power heuristic with exponent 2 (Veach 1997, section 9.2.4): the weight of a sample taken with
// density `own` that could also have been taken with density `other`.
INLINE real power_heuristic(real own, real other) {
    const real ratio = other / own;
    return 1.0f / fma(ratio, ratio, (real)(1.0f));
}

#endif
