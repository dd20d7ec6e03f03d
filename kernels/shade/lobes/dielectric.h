// Glass: reflection and refraction at a rough or smooth boundary (Walter et al. 2007).
// Radiance is scaled by 1 / eta^2 where it is refracted. What a rough boundary loses between its
// microfacets leaves it evenly, to both sides (Kulla and Conty, "Revisiting Physically Based
// Shading at Imageworks", 2017).
#ifndef ONDE_SHADE_LOBES_DIELECTRIC_H
#define ONDE_SHADE_LOBES_DIELECTRIC_H

#include "shade/facets.h"
#include "shade/lobes/lobe.h"

typedef struct {
    real3 tint; // of what goes through
    real alpha;
    mask beckmann;
    real eta; // index below over index above
#if ONDE_TRANSMISSION
    real share; // of the surface that is clear
#endif
#if ONDE_SPECULAR
    real specular; // of what is reflected, but for what must be
#endif
#if ONDE_DISPERSION
    mask disperses; // eta is that of the wavelength
    mask inside;    // the directions above are
    real split;     // the eta that splits light; outside one for all wavelengths, as what is
                    // reflected there keeps all
#endif
#if ONDE_ROUGH_GLASS
    AlbedoRow row;
    mask front;      // whether the directions above lie outside
    real lost;       // between microfacets, of light along wo
    real below;      // the part of that which comes out below
    real2 mean_lost; // of light from above, and from below
    __global const uint* albedos;
#endif
} DielectricLobe;

// However rough, a boundary of equal indices turns no light around.
#define EQUAL_INDICES 1e-4f

#if ONDE_ROUGH_GLASS
// What is lost of light from above and from below.
INLINE real2 dielectric_lost(DielectricLobe lobe, real2 albedos) {
    const real outside = 1.0f - albedos.x, inside = 1.0f - albedos.y;
    return make2(choose(lobe.front, outside, inside), choose(lobe.front, inside, outside));
}

INLINE DielectricLobe dielectric_losses(SceneView view, MaterialPoint m, DielectricLobe lobe) {
    const natural table = RECORD_NATURAL(view.materials, m.material, MaterialRecord, albedos);
    lobe.row = albedo_row(table, lobe.alpha);
    lobe.albedos = view.albedos;
    lobe.front = m.front;
    const mask rough = lobe.alpha >= SMOOTH_ALPHA;
    const real2 lost = dielectric_lost(lobe, albedo_numbers(view.albedos, lobe.row, m.cosine));
    const real2 mean = dielectric_lost(lobe, albedo_means(view.albedos, lobe.row));
    const real least = (real)(1e-5f);
    lobe.mean_lost = make2(max_real(mean.x, least), max_real(mean.y, least));
    lobe.lost = choose(rough, lost.x, (real)(0.0f));
    // Both sides send each other the same, in units of their own media.
    lobe.below =
        mean_transmission(lobe.eta) * min_real(lobe.mean_lost.y / lobe.mean_lost.x, (real)(1.0f));
    return lobe;
}
#endif

INLINE DielectricLobe dielectric_load(SceneView view, MaterialPoint m) {
    DielectricLobe lobe;
    lobe.tint = m.color;
    const real ior = RECORD(view.materials, m.material, MaterialRecord, ior);
    lobe.alpha = choose(fabs(ior - 1.0f) < EQUAL_INDICES, (real)(0.0f), m.alpha);
    lobe.beckmann = m.beckmann;
    real own = ior;
#if ONDE_DISPERSION
    const real dispersion = RECORD(view.materials, m.material, MaterialRecord, dispersion);
    lobe.disperses = dispersion > 0.0f;
    lobe.inside = !m.front;
    const real bent = fma((ior - 1.0f) * dispersion * 0.05f, m.bend, ior);
    own = choose(lobe.disperses, max_real(bent, min_real(ior, (real)(1.0f))), ior);
#endif
    lobe.eta = choose(m.front, own, 1.0f / own);
#if ONDE_DISPERSION
    lobe.split = choose(m.front & (ior > 1.0f), ior, lobe.eta);
#endif
#if ONDE_TRANSMISSION
    lobe.share = clear_share(m);
#endif
#if ONDE_SPECULAR
    lobe.specular = m.f90;
#endif
#if ONDE_ROUGH_GLASS
    lobe = dielectric_losses(view, m, lobe);
#endif
    return lobe;
}
INLINE real dielectric_share(DielectricLobe lobe) {
#if ONDE_TRANSMISSION
    return lobe.share;
#else
    return (real)(1.0f);
#endif
}
INLINE real dielectric_weight(DielectricLobe lobe, MaterialPoint m) {
    return dielectric_share(lobe);
}

// What a boundary reflects of light under a cosine, which may be negative by rounding.
INLINE real dielectric_fresnel(DielectricLobe lobe, real cosine) {
    real eta = lobe.eta;
#if ONDE_DISPERSION
    eta = lobe.split;
#endif
    real fresnel = fresnel_dielectric(max_real(cosine, (real)(0.0f)), eta);
#if ONDE_SPECULAR
    fresnel *= choose(fresnel < 1.0f, lobe.specular, (real)(1.0f));
#endif
    return fresnel;
}

// Refracts wo about h (dot(wo, h) >= 0); meaningless under total internal reflection.
INLINE real3 refract_about(real3 wo, real3 h, real eta) {
    const real cosine = dot3(wo, h);
    const real sine2 = max_real(1.0f - cosine * cosine, (real)(0.0f)) / (eta * eta);
    const real refracted = safe_sqrt(1.0f - sine2);
    const real inverse = 1.0f / eta;
    return madd3(h, fma(cosine, inverse, -refracted), scale3(wo, -inverse));
}

// A rough boundary between wo and wi.
typedef struct {
    real3 h;
    real out, in; // cosines with h
    real fresnel;
    real jacobian; // of refraction, from solid angles of wi to those of h
    mask below;    // wi is
    mask possible;
} Boundary;

INLINE Boundary boundary_between(DielectricLobe lobe, real3 wo, real3 wi) {
    Boundary b;
    b.below = wi.z < 0.0f;
    b.h = normalize3(madd3(wi, choose(b.below, lobe.eta, (real)(1.0f)), wo));
    b.h = choose(b.h.z < 0.0f, negate3(b.h), b.h);
    b.out = dot3(wo, b.h);
    b.in = dot3(wi, b.h);
    b.fresnel = dielectric_fresnel(lobe, b.out);
    // Walter's denominator, in units of the transmitted index.
    const real spread = b.in + b.out / lobe.eta;
    b.jacobian = fabs(b.in) / (spread * spread);
    b.possible = (b.out > 0.0f) & (choose(b.below, -b.in, b.in) > 0.0f) & (wi.z != 0.0f);
    return b;
}
INLINE mask dielectric_is_smooth(DielectricLobe lobe) {
    return lobe.alpha < SMOOTH_ALPHA;
}

#if ONDE_ROUGH_GLASS
// Adds what has met several microfacets.
INLINE LobeValue dielectric_regained(DielectricLobe lobe, real3 wi, LobeValue v, mask below) {
    const real cosine = fabs(wi.z);
    const real2 lost = dielectric_lost(lobe, albedo_numbers(lobe.albedos, lobe.row, cosine));
    const real over = INV_PI * cosine * lobe.lost;
    const real up = (1.0f - lobe.below) * lost.x / lobe.mean_lost.x;
    const real down = lobe.below * lost.y / (lobe.mean_lost.y * lobe.eta * lobe.eta);
    v.value = add3(v.value, splat3(over * choose(below, down, up)));
    const real even = INV_PI * cosine * choose(below, lobe.below, 1.0f - lobe.below);
    v.pdf = fma(lobe.lost, even - v.pdf, v.pdf);
    return v;
}
#endif

INLINE LobeValue dielectric_eval(DielectricLobe lobe, real3 wo, real3 wi, mask lanes) {
    LobeValue v = no_lobe_value();
#if ONDE_ROUGH_GLASS
    const mask rough = lanes & (lobe.alpha >= SMOOTH_ALPHA);
    if (!mask_bits(rough)) return v;
    const Boundary b = boundary_between(lobe, wo, wi);
    const mask possible = rough & b.possible;
    const real d = facet_distribution(b.h, lobe.alpha, lobe.beckmann);
    const real body = d * facet_masking_shadowing(wo, wi, lobe.alpha, lobe.beckmann) / wo.z;
    const real refracted = (1.0f - b.fresnel) * body * b.out * b.jacobian;
    v.tint = choose(b.below, lobe.tint, splat3((real)(1.0f)));
    v.value = splat3(choose(b.below, refracted / (lobe.eta * lobe.eta), b.fresnel * body * 0.25f));
    v.value = choose(possible, v.value, zero3());

    const real seen = facet_masking(wo, lobe.alpha, lobe.beckmann) * d;
    const real visible = seen * max_real(b.out, (real)(0.0f)) / wo.z;
    const real mirrored = b.fresnel * visible / (4.0f * max_real(b.out, (real)(1e-9f)));
    const real pdf = choose(b.below, (1.0f - b.fresnel) * visible * b.jacobian, mirrored);
    v.pdf = choose(possible, pdf, v.pdf);
    v = dielectric_regained(lobe, wi, v, b.below);
    v.tint = choose(rough, scale3(v.tint, dielectric_share(lobe)), zero3());
    v.value = choose(rough, v.value, zero3());
    v.pdf = choose(rough, v.pdf, (real)(0.0f));
#endif
    return v;
}

// Reflects with the Fresnel probability, else refracts, about a visible normal (the macroscopic
// one when alpha is smooth).
INLINE LobeSample dielectric_sample(DielectricLobe lobe, real3 wo, real choice, real2 u) {
    LobeSample s;
    s.delta = lobe.alpha < SMOOTH_ALPHA;
    real3 h = make3((real)(0.0f), (real)(0.0f), (real)(1.0f));
#if ONDE_ROUGH_GLASS
    const mask even = choice < lobe.lost;
    const mask falls = choice < lobe.lost * lobe.below;
    choice = (choice - lobe.lost) / max_real(1.0f - lobe.lost, (real)(1e-6f));
    h = choose(s.delta, h,
               sample_facet(wo, max_real(lobe.alpha, (real)(SMOOTH_ALPHA)), lobe.beckmann, u));
#endif
    const real fresnel = dielectric_fresnel(lobe, dot3(wo, h));
    const mask refracted = choice >= fresnel;
    s.wi = choose(refracted, refract_about(wo, h, lobe.eta), reflect_about(wo, h));
    const real3 tint = scale3(lobe.tint, 1.0f / (lobe.eta * lobe.eta));
    s.weight = scale3(choose(refracted, tint, splat3((real)(1.0f))), dielectric_share(lobe));
    s.valid = choose(refracted, -s.wi.z, s.wi.z) > 0.0f;
#if ONDE_ROUGH_GLASS
    if_any (even) {
        const real3 up = sample_cosine_hemisphere(u);
        const real3 wi = choose(falls, negate3(up), up);
        s.wi = choose(even, wi, s.wi);
        s.valid = choose(even, up.z > 0.0f, s.valid);
    }
#endif
    return s;
}

#endif
