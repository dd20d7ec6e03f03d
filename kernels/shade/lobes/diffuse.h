// Lambert's reflector, under what a glossy coat lets through.
#ifndef ONDE_SHADE_LOBES_DIFFUSE_H
#define ONDE_SHADE_LOBES_DIFFUSE_H

#include "shade/lobes/glossy.h"

typedef struct {
    real3 albedo;
    GlossyLobe coat; // its Fresnel term is 0 where there is none
} DiffuseLobe;

INLINE DiffuseLobe diffuse_load(SceneView view, MaterialPoint m) {
    const mask bare = m.kind == MATERIAL_DIFFUSE;
    DiffuseLobe lobe;
    lobe.albedo = scale3(m.color, 1.0f - choose(bare, (real)(0.0f), m.metallic));
    lobe.coat = glossy_load(view, m);
    lobe.coat.f0 = choose(bare, zero3(), lobe.coat.f0);
    lobe.coat.f90 = choose(bare, (real)(0.0f), lobe.coat.f90);
    return lobe;
}
INLINE real diffuse_weight(DiffuseLobe lobe, real cosine) {
    return luminance3(lobe.albedo) * (1.0f - luminance3(glossy_fresnel(lobe.coat, cosine)));
}

INLINE LobeValue diffuse_eval(DiffuseLobe lobe, real3 wo, real3 wi) {
    const real3 coat = glossy_fresnel(lobe.coat, dot3(wo, half_vector(wo, wi)));
    const mask above = wi.z > 0.0f;
    LobeValue v;
    v.tint = make3(1.0f - coat.x, 1.0f - coat.y, 1.0f - coat.z);
    v.value = scale3(lobe.albedo, max_real(wi.z, (real)(0.0f)) * INV_PI);
    v.tint = choose(above, v.tint, zero3());
    return v;
}
INLINE real diffuse_pdf(DiffuseLobe lobe, real3 wo, real3 wi) {
    return choose(wi.z > 0.0f, pdf_cosine_hemisphere(wi.z), (real)(0.0f));
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
