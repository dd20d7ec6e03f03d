// A thin wall of clear matter: light is reflected, or goes on behind it as it came, blurred by its
// roughness. As glTF's transmission it reflects once (KHR_materials_transmission); as a dielectric
// of its own it is a slab between whose faces light goes to and fro.
#ifndef ONDE_SHADE_LOBES_THIN_H
#define ONDE_SHADE_LOBES_THIN_H

#include "shade/lobes/dielectric.h"

typedef struct {
    real3 tint; // of what goes through
    real share; // of the surface that is clear
    real alpha;
    mask beckmann;
    real ior;
#if ONDE_SPECULAR
    real specular; // of the reflection of a face
#endif
    mask slab;
#if ONDE_ALBEDOS
    AlbedoRow row;
    real lost; // between microfacets, of light along wo
    real mean_lost;
    real behind; // the part of that which comes out there
    __global const uint* albedos;
#endif
} ThinLobe;

// The reflectance of one face, or of all passages between two.
INLINE real thin_reflectance(ThinLobe lobe, real face) {
    return choose(lobe.slab, 2.0f * face / (1.0f + face), face);
}
INLINE real thin_fresnel(ThinLobe lobe, real cosine) {
    real face = fresnel_dielectric(max_real(cosine, (real)(0.0f)), lobe.ior);
#if ONDE_SPECULAR
    face *= lobe.specular;
#endif
    return thin_reflectance(lobe, face);
}

INLINE ThinLobe thin_load(SceneView view, MaterialPoint m) {
    ThinLobe lobe;
    lobe.tint = m.color;
    lobe.share = clear_share(m);
#if ONDE_SPECULAR
    lobe.specular = m.f90;
#endif
    lobe.beckmann = m.beckmann;
    lobe.slab = is_of_kind(m, MATERIAL_DIELECTRIC);
    const real ior = RECORD(view.materials, m.material, MaterialRecord, ior);
    lobe.ior = max_real(ior, 1.0f / ior);
    lobe.alpha = choose(lobe.ior < 1.0f + EQUAL_INDICES, (real)(0.0f), m.alpha);
#if ONDE_ALBEDOS
    lobe.row = albedo_row(reflection_table(m), m.alpha);
    lobe.albedos = view.albedos;
    real white = m.albedo.white;
    if (ONDE_ANISOTROPY) // has no grain
        white = reflection_albedo(view.albedos, lobe.row, m.cosine).white;
    lobe.lost = choose(lobe.alpha < SMOOTH_ALPHA, (real)(0.0f), 1.0f - white);
    lobe.mean_lost = max_real(1.0f - albedo_means(view.albedos, lobe.row).x, (real)(1e-5f));
    lobe.behind = 1.0f - thin_reflectance(lobe, 1.0f - mean_transmission(lobe.ior));
#endif
    return lobe;
}
INLINE real thin_weight(ThinLobe lobe, MaterialPoint m) {
    return lobe.share;
}
INLINE mask thin_is_smooth(ThinLobe lobe) {
    return lobe.alpha < SMOOTH_ALPHA;
}

INLINE LobeValue thin_eval(ThinLobe lobe, real3 wo, real3 wi, mask lanes) {
    LobeValue v = no_lobe_value();
#if ONDE_ALBEDOS
    const mask rough = lanes & (lobe.alpha >= SMOOTH_ALPHA);
    if (!mask_bits(rough)) return v;
    const mask behind = wi.z < 0.0f;
    const real cosine = fabs(wi.z);
    const real3 mirrored = make3(wi.x, wi.y, cosine);
    const real3 h = half_vector(wo, mirrored);
    const real d = facet_distribution(h, lobe.alpha, lobe.beckmann);
    const real reflectance = thin_fresnel(lobe, dot3(wo, h));
    const real part = choose(behind, 1.0f - reflectance, reflectance) / (4.0f * wo.z);
    const real single = part * d * facet_masking_shadowing(wo, mirrored, lobe.alpha, lobe.beckmann);
    const real lost = 1.0f - reflection_albedo(lobe.albedos, lobe.row, cosine).white;
    const real even = choose(behind, lobe.behind, 1.0f - lobe.behind) * cosine * INV_PI;
    const real value = fma(even * lobe.lost, lost / lobe.mean_lost, single);
    v.value = choose(rough, splat3(value * lobe.share), zero3());
    v.tint = choose(behind, lobe.tint, splat3((real)(1.0f)));
    const real visible = part * d * facet_masking(wo, lobe.alpha, lobe.beckmann);
    v.pdf = choose(rough, fma(lobe.lost, even - visible, visible), (real)(0.0f));
#endif
    return v;
}

INLINE LobeSample thin_sample(ThinLobe lobe, real3 wo, real choice, real2 u) {
    LobeSample s;
    s.delta = lobe.alpha < SMOOTH_ALPHA;
    real3 mirrored = make3(-wo.x, -wo.y, wo.z);
    real cosine = wo.z;
#if ONDE_ALBEDOS
    const mask even = choice < lobe.lost;
    const mask falls = choice < lobe.lost * lobe.behind;
    choice = (choice - lobe.lost) / max_real(1.0f - lobe.lost, (real)(1e-6f));
    const real3 h = sample_facet(wo, max_real(lobe.alpha, (real)(SMOOTH_ALPHA)), lobe.beckmann, u);
    mirrored = choose(s.delta, mirrored, reflect_about(wo, h));
    cosine = choose(s.delta, cosine, dot3(wo, h));
#endif
    mask behind = choice >= thin_fresnel(lobe, cosine);
#if ONDE_ALBEDOS
    mirrored = choose(even, sample_cosine_hemisphere(u), mirrored);
    behind = choose(even, falls, behind);
#endif
    s.valid = mirrored.z > 0.0f;
    s.wi = make3(mirrored.x, mirrored.y, choose(behind, -mirrored.z, mirrored.z));
    s.weight = scale3(choose(behind, lobe.tint, splat3((real)(1.0f))), lobe.share);
    return s;
}

#endif
