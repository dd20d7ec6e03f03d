// Light that leaves without memory of where it came from: Lambert's reflector, alone or below the
// coat of glTF's dielectric half, which leaves to it what it does not reflect of light along wo:
// with the coat, a white body returns all light. A partial metal is a mix of that half with a metal
// (glTF 2.0, appendix B.2).
#ifndef ONDE_SHADE_LOBES_DIFFUSE_H
#define ONDE_SHADE_LOBES_DIFFUSE_H

#include "shade/lobes/glossy.h"

typedef struct {
    real3 albedo;
#if ONDE_INNER
    real entered; // of a plastic: one over what its coat leaves of light from all sides
    MaterialPoint point;
    SceneView view;
#endif
} DiffuseLobe;

// What a coat of which the albedo is known, and what it reflects beyond Schlick's formula, leaves
// to its body; none at all where it is a mirror.
INLINE real left_of(MaterialPoint m, Albedo albedo, real beyond) {
    const real most = max_component3(m.f0);
    real reflected = schlick_albedo(albedo, most, m.f90) * compensation(albedo, most);
#if ONDE_INNER
    reflected = fma(m.exact * m.f90, beyond, reflected);
#endif
    return max_real(1.0f - reflected, (real)(0.0f));
}
// The same of light along a direction under a cosine.
INLINE real left_along(MaterialPoint m, Albedo albedo, real cosine) {
    real beyond = (real)(0.0f);
#if ONDE_INNER
    if_any (m.exact > 0.0f) beyond = beyond_schlick(cosine, m.ior);
#endif
    return left_of(m, albedo, beyond);
}
INLINE real3 left_by_coat(MaterialPoint m) {
    real3 left = splat3(left_along(m, m.albedo, m.cosine));
#if ONDE_IRIDESCENCE // a film leaves what it does not reflect by colour
    const real3 film = scale3(film_fresnel(m.film, m.f0, m.cosine), m.albedo.white);
    left = mix3(left, sub3(splat3((real)(1.0f)), film), m.iridescence);
#endif
    return left;
}

#if ONDE_INNER
// One over what a plastic's coat leaves of light from all sides.
INLINE real over_left_in_mean(SceneView view, MaterialPoint m) {
    const real2 means = albedo_means(view.albedos, albedo_row(reflection_table(m), m.alpha));
    const mask smooth = m.alpha < SMOOTH_ALPHA;
    Albedo mean;
    mean.white = choose(smooth, (real)(1.0f), means.x);
    mean.grazing = choose(smooth, (real)(1.0f / 21.0f), means.y);
    const real f0 = square((m.ior - 1.0f) / (m.ior + 1.0f));
    const real beyond = 1.0f - mean_transmission(m.ior) - fma(1.0f - f0, (real)(1.0f / 21.0f), f0);
    return 1.0f / max_real(left_of(m, mean, beyond), (real)(1e-3f));
}
// The colour of a plastic's body, to which its coat sends light back (Saunderson 1942).
INLINE real3 inner_color(SceneView view, MaterialPoint m) {
    const real stated = RECORD(view.materials, m.material, MaterialRecord, inner_reflection);
    const real back = max_real(stated, (real)(0.0f));
    const real3 c = m.color;
    const real out = 1.0f - back;
    return make3(c.x * out / fma(-c.x, back, (real)(1.0f)),
                 c.y * out / fma(-c.y, back, (real)(1.0f)),
                 c.z * out / fma(-c.z, back, (real)(1.0f)));
}
// What a plastic's coat leaves of light from one side, over that from all, so that a white body
// returns what enters; 1 of other bodies.
INLINE real share_entered(DiffuseLobe lobe, real3 w, mask lanes) {
    const mask plastic = lanes & lobe.point.plastic;
    real share = (real)(1.0f);
    if_any (plastic) {
        const Albedo albedo = microfacet_albedo(lobe.view, lobe.point, w, plastic);
        const real left = left_along(lobe.point, albedo, fabs(w.z));
        share = choose(plastic, left * lobe.entered, share);
    }
    return share;
}
#endif

INLINE DiffuseLobe diffuse_load(SceneView view, MaterialPoint m) {
    const real share = opaque_share(m, m.metallic) * (1.0f - m.behind);
    const mask mixed = is_of_kind(m, MATERIAL_METALLIC_ROUGHNESS);
#if ONDE_INNER
    m.color = choose(m.plastic, inner_color(view, m), m.color);
#endif
    DiffuseLobe lobe;
    lobe.albedo = choose(mixed, mul3(scale3(m.color, share), left_by_coat(m)), m.color);
#if ONDE_INNER
    lobe.entered = over_left_in_mean(view, m);
    lobe.point = m;
    lobe.view = view;
#endif
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
#if ONDE_INNER // of the direction that the albedo does not know
    v.value = scale3(v.value, share_entered(lobe, ONDE_ADJOINT ? wo : wi, above));
#endif
    v.pdf = choose(above, pdf_cosine_hemisphere(wi.z), (real)(0.0f));
    return v;
}
INLINE LobeSample diffuse_sample(DiffuseLobe lobe, real3 wo, real choice, real2 u) {
    return cosine_lobe_sample(u);
}

#endif
