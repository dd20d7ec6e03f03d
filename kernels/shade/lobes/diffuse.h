// Lambert's reflector, under what a glossy coat lets through.
#ifndef ONDE_SHADE_LOBES_DIFFUSE_H
#define ONDE_SHADE_LOBES_DIFFUSE_H

#include "shade/lobes/glossy.h"

// Whether some diffuse lobe has a coat.
#define HAS_COATS (ONDE_KINDS & OF_KIND(METALLIC_ROUGHNESS))

typedef struct {
    real3 albedo;
    GlossyLobe coat; // its Fresnel term is 0 where there is none
} DiffuseLobe;

INLINE DiffuseLobe diffuse_load(SceneView view, MaterialPoint m) {
    const mask bare = is_of_kind(m, MATERIAL_DIFFUSE);
    DiffuseLobe lobe;
    lobe.albedo = scale3(m.color, 1.0f - choose(bare, (real)(0.0f), m.metallic));
    lobe.coat = glossy_load(view, m);
    lobe.coat.f0 = choose(bare, zero3(), lobe.coat.f0);
    lobe.coat.f90 = choose(bare, (real)(0.0f), lobe.coat.f90);
    return lobe;
}
INLINE real diffuse_weight(DiffuseLobe lobe, real cosine) {
    const real albedo = luminance3(lobe.albedo);
    return HAS_COATS ? albedo * (1.0f - luminance3(glossy_fresnel(lobe.coat, cosine))) : albedo;
}

INLINE LobeValue diffuse_eval(DiffuseLobe lobe, real3 wo, real3 wi, mask lanes) {
    const mask above = lanes & (wi.z > 0.0f);
    LobeValue v;
    v.tint = splat3((real)(1.0f));
    if (HAS_COATS) v.tint = sub3(v.tint, glossy_fresnel(lobe.coat, dot3(wo, half_vector(wo, wi))));
    v.tint = choose(above, v.tint, zero3());
    v.value = scale3(lobe.albedo, choose(above, wi.z, (real)(0.0f)) * INV_PI);
    v.pdf = choose(above, pdf_cosine_hemisphere(wi.z), (real)(0.0f));
    return v;
}
INLINE LobeSample diffuse_sample(DiffuseLobe lobe, real3 wo, real choice, real2 u) {
    LobeSample s;
    s.wi = sample_cosine_hemisphere(u);
    s.valid = s.wi.z > 0.0f;
    s.delta = s.valid & !s.valid;
    s.weight = zero3();
    return s;
}

#endif
