// Light that leaves without memory of where it came from: Lambert's reflector, alone or below the
// coat of glTF's dielectric half, which leaves to it what it does not reflect of light along wo:
// with the coat, a white body returns all light. A partial metal is a mix of that half with a metal
// (glTF 2.0, appendix B.2).
#ifndef ONDE_SHADE_LOBES_DIFFUSE_H
#define ONDE_SHADE_LOBES_DIFFUSE_H

#include "shade/lobes/glossy.h"

typedef struct {
    real3 albedo;
} DiffuseLobe;

// What a coat leaves to its body; none at all where it is a mirror.
INLINE real3 left_by_coat(MaterialPoint m) {
    const real most = max_component3(m.f0);
    const real reflected = schlick_albedo(m.albedo, most, m.f90) * compensation(m.albedo, most);
    real3 left = splat3(max_real(1.0f - reflected, (real)(0.0f)));
#if ONDE_IRIDESCENCE // a film leaves what it does not reflect by colour
    const real3 film = scale3(film_fresnel(m.film, m.f0, m.cosine), m.albedo.white);
    left = mix3(left, sub3(splat3((real)(1.0f)), film), m.iridescence);
#endif
    return left;
}

#if ONDE_INNER
// The colour of a body to which a coat sends light back (Saunderson 1942, without the light that
// the coat reflects at once).
INLINE real3 inner_color(SceneView view, MaterialPoint m) {
    const real back = RECORD(view.materials, m.material, MaterialRecord, inner_reflection);
    const real3 c = m.color;
    const real out = 1.0f - back;
    return make3(c.x * out / fma(-c.x, back, (real)(1.0f)),
                 c.y * out / fma(-c.y, back, (real)(1.0f)),
                 c.z * out / fma(-c.z, back, (real)(1.0f)));
}
#endif

INLINE DiffuseLobe diffuse_load(SceneView view, MaterialPoint m) {
    const real share = opaque_share(m, m.metallic) * (1.0f - m.behind);
    const mask mixed = is_of_kind(m, MATERIAL_METALLIC_ROUGHNESS);
#if ONDE_INNER
    m.color = choose(mixed, inner_color(view, m), m.color);
#endif
    DiffuseLobe lobe;
    lobe.albedo = choose(mixed, mul3(scale3(m.color, share), left_by_coat(m)), m.color);
    return lobe;
}
INLINE real diffuse_weight(DiffuseLobe lobe, MaterialPoint m) {
    return luminance3(lobe.albedo);
}
INLINE mask diffuse_is_smooth(DiffuseLobe lobe) {
    return (mask)(0);
}

INLINE LobeValue diffuse_eval(DiffuseLobe lobe, real3 wo, real3 wi, mask lanes) {
    const mask above = lanes & (wi.z > 0.0f);
    LobeValue v;
    v.tint = splat3(choose(above, (real)(1.0f), (real)(0.0f)));
    v.value = scale3(lobe.albedo, choose(above, wi.z, (real)(0.0f)) * INV_PI);
    v.pdf = choose(above, pdf_cosine_hemisphere(wi.z), (real)(0.0f));
    return v;
}
INLINE LobeSample diffuse_sample(DiffuseLobe lobe, real3 wo, real choice, real2 u) {
    return cosine_lobe_sample(u);
}

#endif
