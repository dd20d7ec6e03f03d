// Shading normals that are not the surface's own and would mirror the viewer's ray into the
// surface.
#ifndef ONDE_SHADE_SHADING_NORMAL_H
#define ONDE_SHADE_SHADING_NORMAL_H

#include "shade/material.h"

// Whether some material of the scene mirrors at all, be it dimly.
#define HAS_MIRRORING (HAS_LOBE(GLOSSY) || HAS_LOBE(DIELECTRIC))

// The shading normal of a surface as seen along `direction`, bent until the mirror direction lies
// above the surface, as Keller et al. do ("The Iray Light Transport Simulation and Rendering
// System", 2017). What only scatters keeps its own.
INLINE real3 valid_normal(SceneView view, Surface s, real3 direction) {
    if (!HAS_MIRRORING) return s.normal;
    const real3 mirrored = madd3(s.normal, -2.0f * dot3(s.normal, direction), direction);
    const real least = min_real(-0.9f * dot3(direction, s.geometric), (real)(0.01f));
    const real missing = least - dot3(mirrored, s.geometric);
    if (!mask_bits(missing > 0.0f)) return s.normal; // as on all that is flat
    const natural kind = RECORD_NATURAL(view.materials, s.material, MaterialRecord, kind);
    const real3 lifted = normalize3(madd3(s.geometric, missing, mirrored));
    const real3 bent = normalize3(sub3(lifted, direction));
    return choose((missing > 0.0f) & (kind != MATERIAL_DIFFUSE), bent, s.normal);
}

#endif
