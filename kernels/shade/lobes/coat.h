// Varnish on top of a surface: a boundary of index 1.5 with a roughness and a normal of its own
// (KHR_materials_clearcoat). What it does not reflect goes on to what lies below.
#ifndef ONDE_SHADE_LOBES_COAT_H
#define ONDE_SHADE_LOBES_COAT_H

#include "shade/lobes/glossy.h"

typedef struct {
    real amount; // of the surface that has it
    real alpha;
    Basis basis; // of its own normal, in local directions
    AlbedoRow row;
    __global const uint* albedos;
} CoatLobe;

INLINE CoatLobe coat_load(SceneView view, MaterialPoint m) {
    CoatLobe lobe;
    lobe.amount = m.clearcoat;
    lobe.alpha = m.coat_alpha;
    lobe.basis = make_basis(m.coat_normal);
    lobe.row = albedo_row((natural)(0u), lobe.alpha);
    lobe.albedos = view.albedos;
    return lobe;
}

// A direction as the coat sees it; its own normal is the surface's where there are no normal maps.
INLINE real3 coat_direction(CoatLobe lobe, real3 w) {
    return ONDE_NORMAL_MAPS ? to_local(lobe.basis, w) : w;
}
INLINE real3 coat_outward(CoatLobe lobe, real3 w) {
    real3 own = coat_direction(lobe, w);
    own.z = max_real(own.z, (real)(1e-4f));
    return own;
}
INLINE real coat_fresnel(real cosine) {
    return fma((real)(1.0f - DIELECTRIC_F0), schlick_weight(cosine), (real)(DIELECTRIC_F0));
}

// What it reflects of light along w.
INLINE real coat_albedo(CoatLobe lobe, real3 w) {
    const real cosine = clamp_real(fabs(coat_direction(lobe, w).z), 1e-4f, 1.0f);
    const Albedo a = reflection_albedo(lobe.albedos, lobe.row, cosine);
    return lobe.amount * schlick_albedo(a, (real)(DIELECTRIC_F0), (real)(1.0f));
}
INLINE real coat_weight(CoatLobe lobe, MaterialPoint m) {
    return lobe.amount * coat_fresnel(m.cosine);
}
INLINE mask coat_is_smooth(CoatLobe lobe) {
    return lobe.alpha < SMOOTH_ALPHA;
}

INLINE LobeValue coat_eval(CoatLobe lobe, real3 wo, real3 wi, mask lanes) {
    LobeValue v = no_lobe_value();
    if (!ONDE_ROUGH) return v;
    const real3 out = coat_outward(lobe, wo), in = coat_direction(lobe, wi);
    const mask seen = lanes & (lobe.alpha >= SMOOTH_ALPHA) & (wi.z > 0.0f) & (in.z > 0.0f);
    if_any (seen) {
        const real3 h = half_vector(out, in);
        const real d = ggx_distribution(h, lobe.alpha) / (4.0f * out.z);
        const real single = d * ggx_masking_shadowing(out, in, lobe.alpha);
        const real reflected = lobe.amount * coat_fresnel(dot3(out, h));
        v.tint = choose(seen, splat3(reflected), v.tint);
        v.value = choose(seen, splat3(single), v.value);
        v.pdf = choose(seen, d * ggx_masking(out, lobe.alpha), v.pdf);
    }
    return v;
}

INLINE LobeSample coat_sample(CoatLobe lobe, real3 wo, real choice, real2 u) {
    const real3 out = coat_outward(lobe, wo);
    const real3 h = sample_visible_normal(out, max_real(lobe.alpha, (real)(SMOOTH_ALPHA)), u);
    LobeSample s;
    s.delta = lobe.alpha < SMOOTH_ALPHA;
    const real3 in = choose(s.delta, make3(-out.x, -out.y, out.z), reflect_about(out, h));
    s.wi = ONDE_NORMAL_MAPS ? to_world(lobe.basis, in) : in;
    s.weight = splat3(lobe.amount * coat_fresnel(out.z));
    s.valid = (s.wi.z > 0.0f) & (in.z > 0.0f);
    return s;
}

#endif
