// Microfacets of either distribution: GGX's, or Beckmann's in the lanes of `beckmann`. Alphas are a
// number, or two where there is a grain.
#ifndef ONDE_SHADE_FACETS_H
#define ONDE_SHADE_FACETS_H

#include "shade/microfacet.h"

#if ONDE_BECKMANN
    #include "shade/beckmann.h"

OVERLOAD real2 both_alphas(real alpha) {
    return make2(alpha, alpha);
}
OVERLOAD real2 both_alphas(real2 alpha) {
    return alpha;
}
    // `own` of the lanes that are Beckmann's.
    #define OR_BECKMANN(value, own)                                                                \
        if_any (beckmann) value = choose(beckmann, own, value)
#else
    #define OR_BECKMANN(value, own)
#endif

#define FACET_FUNCTIONS(Alpha)                                                                     \
    OVERLOAD real facet_distribution(real3 h, Alpha alpha, mask beckmann) {                        \
        real d = ggx_distribution(h, alpha);                                                       \
        OR_BECKMANN(d, beckmann_distribution(h, both_alphas(alpha)));                              \
        return d;                                                                                  \
    }                                                                                              \
    OVERLOAD real facet_masking(real3 w, Alpha alpha, mask beckmann) {                             \
        real g = ggx_masking(w, alpha);                                                            \
        OR_BECKMANN(g, 1.0f / (1.0f + beckmann_lambda(w, both_alphas(alpha))));                    \
        return g;                                                                                  \
    }                                                                                              \
    OVERLOAD real facet_masking_shadowing(real3 wo, real3 wi, Alpha alpha, mask beckmann) {        \
        real g = ggx_masking_shadowing(wo, wi, alpha);                                             \
        OR_BECKMANN(g, 1.0f / (1.0f + beckmann_lambda(wo, both_alphas(alpha)) +                    \
                               beckmann_lambda(wi, both_alphas(alpha))));                          \
        return g;                                                                                  \
    }                                                                                              \
    /* As those visible from wo, wo.z > 0. */                                                      \
    OVERLOAD real3 sample_facet(real3 wo, Alpha alpha, mask beckmann, real2 u) {                   \
        real3 h = sample_visible_normal(wo, alpha, u);                                             \
        OR_BECKMANN(h, beckmann_visible_normal(wo, both_alphas(alpha), u));                        \
        return h;                                                                                  \
    }
FACET_FUNCTIONS(real)
FACET_FUNCTIONS(real2)

#endif
