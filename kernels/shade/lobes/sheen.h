// Fibres that stand on a surface (KHR_materials_sheen): the distribution of Estevez and Kulla,
// "Production Friendly Microfacet Sheen BRDF", 2017, and the visibility of Neubelt and Pettineo,
// "Crafting a Next-Gen Material Pipeline for The Order: 1886", 2013.
#ifndef ONDE_SHADE_LOBES_SHEEN_H
#define ONDE_SHADE_LOBES_SHEEN_H

#include "shade/lobes/glossy.h"

// Below, fibres that stand are needles that float grids can't hold.
#define LEAST_SHEEN_ROUGHNESS 0.07f

typedef struct {
    real3 color;
    real alpha;
    AlbedoRow row;
    __global const uint* albedos;
} SheenLobe;

INLINE SheenLobe sheen_load(SceneView view, MaterialPoint m) {
    SheenLobe lobe;
    lobe.color = m.sheen_color;
    lobe.alpha = m.sheen_alpha;
    lobe.row = albedo_row((natural)(SHEEN_TABLE), lobe.alpha);
    lobe.row.alpha = (real)(SHEEN_PLACE_ALPHA);
    lobe.albedos = view.albedos;
    return lobe;
}
// What it scatters of light along w.
INLINE real sheen_albedo(SheenLobe lobe, real3 w) {
    const real cosine = clamp_real(fabs(w.z), 1e-4f, 1.0f);
    return max_component3(lobe.color) * albedo_numbers(lobe.albedos, lobe.row, cosine).x;
}
INLINE real sheen_weight(SheenLobe lobe, MaterialPoint m) {
    return luminance3(lobe.color) * albedo_numbers(lobe.albedos, lobe.row, m.cosine).x;
}
INLINE mask sheen_is_smooth(SheenLobe lobe) {
    return (mask)(0);
}

INLINE LobeValue sheen_eval(SheenLobe lobe, real3 wo, real3 wi, mask lanes) {
    const mask above = lanes & (wi.z > 0.0f);
    LobeValue v = no_lobe_value();
    if_any (above) {
        const real3 h = half_vector(wo, wi);
        const real inverse = 1.0f / lobe.alpha;
        const real power = power_below_one(min_real(h.z * h.z, (real)(1.0f)), 0.5f * inverse);
        const real d = (2.0f + inverse) * power * (0.5f * INV_PI);
        const real visibility = 0.25f / fma(-wi.z, wo.z, wi.z + wo.z);
        v.tint = choose(above, lobe.color, v.tint);
        v.value = choose(above, splat3(d * visibility * wi.z), v.value);
        v.pdf = choose(above, pdf_cosine_hemisphere(wi.z), v.pdf);
    }
    return v;
}
INLINE LobeSample sheen_sample(SheenLobe lobe, real3 wo, real choice, real2 u) {
    return cosine_lobe_sample(u);
}

#endif
