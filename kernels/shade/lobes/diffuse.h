// Lambert's reflector. Under the coat of glTF's dielectric half it has what the coat lets through:
// a partial metal is a mix of that half with a metal (glTF 2.0, appendix B.2).
#ifndef ONDE_SHADE_LOBES_DIFFUSE_H
#define ONDE_SHADE_LOBES_DIFFUSE_H

#include "shade/lobes/glossy.h"

// Whether some diffuse lobe has a coat.
#define HAS_COATS (ONDE_KINDS & OF_KIND(METALLIC_ROUGHNESS))

typedef struct {
    real3 albedo;
    real coat; // 1 where there is one, else 0
} DiffuseLobe;

INLINE DiffuseLobe diffuse_load(SceneView view, MaterialPoint m) {
    const mask bare = is_of_kind(m, MATERIAL_DIFFUSE);
    const real zero = (real)(0.0f), one = (real)(1.0f);
    DiffuseLobe lobe;
    lobe.albedo = scale3(m.color, 1.0f - choose(bare, zero, m.metallic));
    lobe.coat = choose(bare, zero, one);
    return lobe;
}

// What the coat lets through.
INLINE real diffuse_through(DiffuseLobe lobe, real cosine) {
    const real reflected =
        fma((real)(1.0f - DIELECTRIC_F0), schlick_weight(cosine), (real)(DIELECTRIC_F0));
    return HAS_COATS ? fma(-lobe.coat, reflected, (real)(1.0f)) : (real)(1.0f);
}
INLINE real diffuse_weight(DiffuseLobe lobe, real cosine) {
    return luminance3(lobe.albedo) * diffuse_through(lobe, cosine);
}
INLINE mask diffuse_is_smooth(DiffuseLobe lobe) {
    return (mask)(0);
}

INLINE LobeValue diffuse_eval(DiffuseLobe lobe, real3 wo, real3 wi, mask lanes) {
    const mask above = lanes & (wi.z > 0.0f);
    const real through = diffuse_through(lobe, dot3(wo, half_vector(wo, wi)));
    LobeValue v;
    v.tint = splat3(choose(above, through, (real)(0.0f)));
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
