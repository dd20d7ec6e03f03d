// Beckmann's distribution of microfacet normals: Gaussian slopes, of which few are steep, so that
// highlights have no tails (Walter et al. 2007, Microfacet Models for Refraction). Directions are
// local; two alphas, along the grain (x) and across.
#ifndef ONDE_SHADE_BECKMANN_H
#define ONDE_SHADE_BECKMANN_H

#include "math/error_function.h"
#include "math/sampling.h"

// Walter et al. 2007, eq. 25.
INLINE real beckmann_distribution(real3 h, real2 alpha) {
    const real up = max_real(h.z, (real)(1e-4f));
    const real x = h.x / (alpha.x * up), y = h.y / (alpha.y * up);
    const real steep = exp2_real(-1.44269504f * fma(x, x, y * y));
    return steep / (PI * alpha.x * alpha.y * square(up * up));
}

// Smith's Lambda (Heitz 2014, eq. 66).
INLINE real beckmann_lambda(real3 w, real2 alpha) {
    const real x = alpha.x * w.x, y = alpha.y * w.y;
    const real flat = sqrt(max_real(fma(x, x, y * y), (real)(1e-12f)));
    const real a = fabs(w.z) / flat;
    const real own = 0.5f * (INV_SQRT_PI / max_real(a, (real)(1e-6f)) - scaled_complement(a));
    return max_real(own * gaussian(a), (real)(0.0f));
}

// The slope, in units of alpha and along the view, of what is seen from an angle to the normal: by
// inverting its distribution over erf(slope), in which it is smooth (Jakob 2014, An Improved
// Visible Normal Sampling Routine for the Beckmann Distribution). Two steps from that paper's first
// guess are within 3e-6.
INLINE real beckmann_slope(SineCosine angle, real u) {
    const real cotangent =
        min_real(angle.cosine / max_real(angle.sine, (real)(1e-6f)), (real)(9.0f));
    const real most = error_function(cotangent);
    const real part = 0.5f * INV_SQRT_PI * angle.sine;
    const real all = fma(0.5f * angle.cosine, 1.0f + most, part * gaussian(cotangent));
    const real radians = angle_turns(angle.sine, angle.cosine) * (2.0f * PI);
    real fit = fma(radians, (real)(-0.0594f), (real)(0.4265f));
    fit = fma(radians, fma(radians, fit, (real)(-0.876f)), (real)(1.0f));
    const real left = max_real(1.0f - u, (real)(1e-6f));
    real b = fma(-(1.0f + most), exp2_real(fit * log2_real(left)), most);
    real slope = (real)(0.0f);
    for (uint step = 0; step < 3u; step++) {
        b = clamp_real(b, -0.999999f, 0.999999f);
        slope = inverse_error_function(b);
        const real below = fma(0.5f * angle.cosine, 1.0f + b, part * gaussian(slope));
        const real rate = 0.5f * fma(-slope, angle.sine, angle.cosine);
        b -= (below - u * all) / max_real(rate, (real)(1e-6f));
    }
    return slope;
}

// A normal distributed as those visible from wo (wo.z > 0).
INLINE real3 beckmann_visible_normal(real3 wo, real2 alpha, real2 u) {
    const real3 v = normalize3(make3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    const real flat2 = fma(v.x, v.x, v.y * v.y);
    const mask upright = flat2 < 1e-12f;
    const real scale = 1.0f / sqrt(choose(upright, (real)(1.0f), flat2));
    const real c = choose(upright, (real)(1.0f), v.x * scale);
    const real s = choose(upright, (real)(0.0f), v.y * scale);
    SineCosine angle;
    angle.sine = choose(upright, (real)(0.0f), flat2 * scale);
    angle.cosine = v.z;
    const real along = beckmann_slope(angle, u.x);
    const real across = inverse_error_function(
        clamp_real(fma(u.y, (real)(2.0f), (real)(-1.0f)), -0.999999f, 0.999999f));
    const real x = fma(c, along, -(s * across)), y = fma(s, along, c * across);
    return normalize3(make3(-alpha.x * x, -alpha.y * y, (real)(1.0f)));
}

#endif
