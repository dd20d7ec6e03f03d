// Reflection by GGX microfacets (conductors, the specular part of glTF's mix). The Fresnel factor
// is the caller's. Local directions, both above the surface.
#ifndef ONDE_SHADE_LOBES_GLOSSY_H
#define ONDE_SHADE_LOBES_GLOSSY_H

#include "shade/microfacet.h"

INLINE real3 reflect_about(real3 wo, real3 h) {
    return madd3(h, 2.0f * dot3(wo, h), negate3(wo));
}

INLINE real3 glossy_sample(real3 wo, real alpha, real2 u) {
    return reflect_about(wo, sample_visible_normal(wo, alpha, u));
}
INLINE real glossy_pdf(real3 wo, real3 h, real alpha) {
    return ggx_masking(wo, alpha) * ggx_distribution(h, alpha) / (4.0f * wo.z);
}
// D G / (4 cos_o cos_i) times cos_i.
INLINE real glossy_eval(real3 wo, real3 wi, real3 h, real alpha) {
    return ggx_distribution(h, alpha) * ggx_masking_shadowing(wo, wi, alpha) / (4.0f * wo.z);
}

#endif
