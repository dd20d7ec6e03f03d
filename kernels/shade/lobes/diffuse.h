// Light that leaves without memory of where it came from: Lambert's reflector, alone or below a
// coat; and what meets several microfacets.
//
// The body of glTF's dielectric half has what the coat does not reflect, on the way in and on the
// way out, over its mean (Kelemen and Szirmay-Kalos, "A Microfacet Based Coupled
// Specular-Matte BRDF Model with Importance Sampling", 2001): with the coat, a white body returns
// all light. A partial metal is a mix of that half with a metal (glTF 2.0, appendix B.2).
// What a rough metal loses between its microfacets leaves it in the same way (Kulla and Conty,
// "Revisiting Physically Based Shading at Imageworks", 2017).
#ifndef ONDE_SHADE_LOBES_DIFFUSE_H
#define ONDE_SHADE_LOBES_DIFFUSE_H

#include "shade/lobes/glossy.h"

typedef struct {
    real3 color;  // of the body
    real3 albedo; // the same; below a coat, times what reaches it over the mean
#if ONDE_ALBEDOS
    real3 between; // microfacets: what is lost there, coloured, over the mean
    AlbedoRow row;
    real coat; // reflectance of the coat at normal incidence
    real f90;  // and at grazing; 0 where there is none
    mask layered;
    __global const uint* albedos;
#endif
    real weight;
} DiffuseLobe;

#if ONDE_ALBEDOS
// The mean over the hemisphere of Schlick's reflectance.
INLINE real mean_fresnel(real f0) {
    return fma(1.0f - f0, (real)(1.0f / 21.0f), f0);
}
// Of the light that microfacets of a mean albedo lose, the part that comes out after all.
INLINE real regained(real f0, real mean_albedo) {
    const real f = mean_fresnel(f0);
    return f * f * mean_albedo / max_real(fma(f, mean_albedo - 1.0f, (real)(1.0f)), (real)(1e-6f));
}

// What a coat lets through; none at all where it is a mirror.
INLINE real coat_lets_through(Albedo a, real f0, real f90) {
    return max_real(1.0f - schlick_albedo(a, f0, f90), (real)(0.0f));
}

INLINE DiffuseLobe diffuse_layered(SceneView view, MaterialPoint m, DiffuseLobe lobe,
                                   mask layered) {
    const Albedo mean = mean_reflection_albedo(view.albedos, m.row);
    const mask coated = layered & !is_of_kind(m, MATERIAL_CONDUCTOR);
    const real zero = (real)(0.0f), one = (real)(1.0f);
    const real metallic = choose(coated, m.metallic, one);
    lobe.row = m.row;
    lobe.albedos = view.albedos;
    real3 f0 = m.f0;
    #if ONDE_IRIDESCENCE
    f0 = mix3(f0, film_fresnel(m.film, f0, one), m.iridescence);
    #endif
    lobe.coat = choose(coated, max_component3(f0), zero);
    lobe.f90 = choose(coated, m.f90, zero);
    const real entering = coat_lets_through(m.albedo, lobe.coat, lobe.f90);
    const real spread = max_real(coat_lets_through(mean, lobe.coat, lobe.f90), (real)(1e-4f));
    const real share = opaque_share(m, metallic) * (1.0f - m.behind);
    const real3 body = scale3(m.color, choose(coated, share, zero));
    const real lost = 1.0f - m.albedo.white;
    const real3 back =
        scale3(make3(regained(m.color.x, mean.white), regained(m.color.y, mean.white),
                     regained(m.color.z, mean.white)),
               metallic * lost);
    lobe.weight = choose(layered, fma(luminance3(body), entering, luminance3(back)), lobe.weight);
    lobe.color = choose(layered, body, lobe.color);
    lobe.albedo = choose(layered, scale3(body, entering / spread), lobe.albedo);
    const real mean_lost = max_real(1.0f - mean.white, (real)(1e-5f));
    lobe.between = choose(layered, scale3(back, 1.0f / mean_lost), zero3());
    return lobe;
}
#endif

INLINE DiffuseLobe diffuse_load(SceneView view, MaterialPoint m) {
    DiffuseLobe lobe;
    lobe.color = lobe.albedo = m.color;
    lobe.weight = luminance3(m.color);
#if ONDE_ALBEDOS
    lobe.layered = is_layered(m);
    lobe.coat = lobe.f90 = (real)(0.0f);
    lobe.between = zero3();
    if_any (lobe.layered) lobe = diffuse_layered(view, m, lobe, lobe.layered);
#endif
    return lobe;
}
INLINE real diffuse_weight(DiffuseLobe lobe, MaterialPoint m) {
    return lobe.weight;
}
INLINE mask diffuse_is_smooth(DiffuseLobe lobe) {
    return (mask)(0);
}

// What comes from the body, times the cosine; nothing where wi is not above.
INLINE real3 diffuse_body(DiffuseLobe lobe, real3 wi, mask lanes) {
    const mask above = lanes & (wi.z > 0.0f);
    real3 albedo = lobe.albedo;
#if ONDE_ALBEDOS
    if_any (above & lobe.layered) {
        const Albedo a = reflection_albedo(lobe.albedos, lobe.row, max_real(wi.z, (real)(0.0f)));
        const real through = coat_lets_through(a, lobe.coat, lobe.f90);
        albedo = choose(lobe.layered, scale3(albedo, through), albedo);
    }
#endif
    return scale3(albedo, choose(above, wi.z, (real)(0.0f)) * INV_PI);
}

INLINE LobeValue diffuse_eval(DiffuseLobe lobe, real3 wo, real3 wi, mask lanes) {
    const mask above = lanes & (wi.z > 0.0f);
    const real cosine = choose(above, wi.z, (real)(0.0f));
    real3 albedo = lobe.albedo;
#if ONDE_ALBEDOS
    if_any (above & lobe.layered) {
        const Albedo a = reflection_albedo(lobe.albedos, lobe.row, cosine);
        const real3 body = scale3(albedo, coat_lets_through(a, lobe.coat, lobe.f90));
        albedo = choose(lobe.layered, madd3(lobe.between, 1.0f - a.white, body), albedo);
    }
#endif
    LobeValue v;
    v.tint = splat3(choose(above, (real)(1.0f), (real)(0.0f)));
    v.value = scale3(albedo, cosine * INV_PI);
    v.pdf = choose(above, pdf_cosine_hemisphere(wi.z), (real)(0.0f));
    return v;
}
INLINE LobeSample diffuse_sample(DiffuseLobe lobe, real3 wo, real choice, real2 u) {
    return cosine_lobe_sample(u);
}

#endif
