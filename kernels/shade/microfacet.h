// The GGX distribution of microfacet normals and Smith's shadowing. Directions are local: the
// macroscopic normal is +z. alpha = roughness^2.
#ifndef ONDE_SHADE_MICROFACET_H
#define ONDE_SHADE_MICROFACET_H

#include "math/sampling.h"
#include "shared/scene.h"

INLINE real3 half_vector(real3 wo, real3 wi) {
    return normalize3(add3(wo, wi));
}
INLINE real3 reflect_about(real3 wo, real3 h) {
    return madd3(h, 2.0f * dot3(wo, h), negate3(wo));
}

// Walter et al. 2007, eq. 33.
OVERLOAD real ggx_distribution(real3 h, real alpha) {
    const real a2 = alpha * alpha;
    const real k = fma(h.z * h.z, a2 - 1.0f, (real)(1.0f));
    return a2 / (PI * k * k);
}

// Smith's Lambda (Heitz 2014, eq. 72).
OVERLOAD real ggx_lambda(real3 w, real alpha) {
    const real cosine2 = w.z * w.z;
    const real tangent2 = max_real(1.0f - cosine2, (real)(0.0f)) / cosine2;
    return 0.5f * (sqrt(fma(alpha * alpha, tangent2, (real)(1.0f))) - 1.0f);
}
OVERLOAD real ggx_masking(real3 w, real alpha) {
    return 1.0f / (1.0f + ggx_lambda(w, alpha));
}

// Height-correlated masking and shadowing (Heitz 2014, eq. 99).
OVERLOAD real ggx_masking_shadowing(real3 wo, real3 wi, real alpha) {
    return 1.0f / (1.0f + ggx_lambda(wo, alpha) + ggx_lambda(wi, alpha));
}

// A normal distributed as those visible from wo (Heitz 2018, Sampling the GGX Distribution of
// Visible Normals), before and after the microfacets are stretched to alpha 1. wo.z > 0.
INLINE real3 sample_stretched_normal(real3 v, real2 u) {
    const real across2 = fma(v.x, v.x, v.y * v.y);
    const mask upright = across2 < 1e-12f;
    const real scale = 1.0f / sqrt(choose(upright, (real)(1.0f), across2));
    const real3 t1 = make3(choose(upright, (real)(1.0f), -v.y * scale),
                           choose(upright, (real)(0.0f), v.x * scale), (real)(0.0f));
    const real3 t2 = cross3(v, t1);
    real2 p = sample_disk(u);
    const real s = 0.5f * (1.0f + v.z);
    p.y = fma(s, p.y, (1.0f - s) * safe_sqrt(1.0f - p.x * p.x));
    const real z = safe_sqrt(1.0f - p.x * p.x - p.y * p.y);
    return madd3(v, z, madd3(t2, p.y, scale3(t1, p.x)));
}
OVERLOAD real3 sample_visible_normal(real3 wo, real alpha, real2 u) {
    const real3 v = normalize3(make3(alpha * wo.x, alpha * wo.y, wo.z));
    const real3 n = sample_stretched_normal(v, u);
    return normalize3(make3(alpha * n.x, alpha * n.y, max_real(n.z, (real)(1e-6f))));
}

// The same where there is a grain: two alphas, along it (x) and across (Heitz 2014, eqs. 85, 86).
// Where they are one, they have the bits of the above.
INLINE mask has_grain(real2 alpha) {
    return alpha.x != alpha.y;
}
OVERLOAD real ggx_distribution(real3 h, real2 alpha) {
    real d = ggx_distribution(h, alpha.y);
    if_any (has_grain(alpha)) {
        const real x = h.x / alpha.x, y = h.y / alpha.y;
        const real k = fma(x, x, fma(y, y, h.z * h.z));
        d = choose(has_grain(alpha), 1.0f / (PI * alpha.x * alpha.y * k * k), d);
    }
    return d;
}
OVERLOAD real ggx_lambda(real3 w, real2 alpha) {
    real lambda = ggx_lambda(w, alpha.y);
    if_any (has_grain(alpha)) {
        const real x = alpha.x * w.x, y = alpha.y * w.y;
        const real slope2 = fma(x, x, y * y) / (w.z * w.z);
        lambda = choose(has_grain(alpha), 0.5f * (sqrt(1.0f + slope2) - 1.0f), lambda);
    }
    return lambda;
}
OVERLOAD real ggx_masking(real3 w, real2 alpha) {
    return 1.0f / (1.0f + ggx_lambda(w, alpha));
}
OVERLOAD real ggx_masking_shadowing(real3 wo, real3 wi, real2 alpha) {
    return 1.0f / (1.0f + ggx_lambda(wo, alpha) + ggx_lambda(wi, alpha));
}
OVERLOAD real3 sample_visible_normal(real3 wo, real2 alpha, real2 u) {
    const real3 v = normalize3(make3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    const real3 n = sample_stretched_normal(v, u);
    return normalize3(make3(alpha.x * n.x, alpha.y * n.y, max_real(n.z, (real)(1e-6f))));
}

#endif
