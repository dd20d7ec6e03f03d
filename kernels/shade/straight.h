// What light does that goes straight through clear surfaces: smooth thin walls; smooth solids where
// no other way finds it; and what it loses inside of solids.
#ifndef ONDE_SHADE_STRAIGHT_H
#define ONDE_SHADE_STRAIGHT_H

#include "shade/material.h"
#include "shade/media.h"

#if ONDE_ABSORPTION
// What is left of light that has come as far as `t` to a surface, inside of what it is the surface
// of.
INLINE real3 solid_transmittance(SceneView view, Surface s, real t) {
    const real3 absorption = RECORD3(view.materials, s.material, MaterialRecord, absorption);
    const real inside = choose(s.front, (real)(0.0f), -t);
    return make3(exp2_real(absorption.x * inside), exp2_real(absorption.y * inside),
                 exp2_real(absorption.z * inside));
}
#endif

#if ONDE_STRAIGHT
// How much goes through the surfaces that rays in `lanes` have hit; nothing in other lanes. unbent:
// lanes whose light passes solids. length: of the way inside, if the rays come from there.
INLINE real3 straight_transmittance(SceneView view, Surface s, real3 direction, real length,
                                    mask unbent, mask lanes) {
    const real cosine = clamp_real(-dot3(direction, s.normal), 1e-4f, 1.0f);
    const real3 wo = make3(safe_sqrt(1.0f - cosine * cosine), (real)(0.0f), cosine);
    const MaterialPoint m = material_point(view, s, wo);
    const natural lobes = RECORD_NATURAL(view.materials, s.material, MaterialRecord, lobes);
    mask clear = lanes & (m.alpha < SMOOTH_ALPHA);
    mask thin = lanes & !lanes;
    real reflectance = (real)(1.0f);
    #if ONDE_PANES
    thin = clear & ((lobes >> LOBE_THIN & 1u) != 0u);
    reflectance = choose(thin, thin_fresnel(thin_load(view, m), cosine), reflectance);
    #endif
    real3 left = splat3((real)(1.0f));
    #if ONDE_UNBENT
    const natural blocks = RECORD_NATURAL(view.materials, s.material, MaterialRecord, blocks);
    const mask solid = clear & unbent & (blocks == 0u) & ((lobes >> LOBE_DIELECTRIC & 1u) != 0u);
    // As parallel faces of a slab reflect: both by the angle outside.
    const real ior = RECORD(view.materials, s.material, MaterialRecord, ior);
    real faces = fresnel_dielectric(cosine, max_real(ior, 1.0f / ior));
        #if ONDE_SPECULAR
    faces *= m.f90;
        #endif
    reflectance = choose(solid, faces, reflectance);
    thin = thin | solid;
        #if ONDE_ABSORPTION
    left = choose(solid, solid_transmittance(view, s, length), left);
        #endif
    #endif
    const real share = choose(thin, clear_share(m) * (1.0f - reflectance), (real)(0.0f));
    return scale3(mul3(m.color, left), share * left_by_layers(view, m, lobes));
}
#endif

#endif
