// Light that a body scatters to its far side, as leaves and paper do
// (KHR_materials_diffuse_transmission): Lambert's reflector, below.
#ifndef ONDE_SHADE_LOBES_BEHIND_H
#define ONDE_SHADE_LOBES_BEHIND_H

#include "shade/lobes/diffuse.h"

typedef struct {
    DiffuseLobe body;
} BehindLobe;

INLINE BehindLobe behind_load(SceneView view, MaterialPoint m) {
    m.color = m.behind_color;
    m.behind = 1.0f - m.behind; // the share that is left to the body
    BehindLobe lobe;
    lobe.body = diffuse_load(view, m);
    return lobe;
}
INLINE real behind_weight(BehindLobe lobe, MaterialPoint m) {
    return lobe.body.weight;
}
INLINE mask behind_is_smooth(BehindLobe lobe) {
    return (mask)(0);
}
INLINE LobeValue behind_eval(BehindLobe lobe, real3 wo, real3 wi, mask lanes) {
    const real3 mirrored = make3(wi.x, wi.y, -wi.z);
    LobeValue v = diffuse_eval(lobe.body, wo, mirrored, lanes);
    v.value = diffuse_body(lobe.body, mirrored, lanes);
    return v;
}
INLINE LobeSample behind_sample(BehindLobe lobe, real3 wo, real choice, real2 u) {
    LobeSample s = diffuse_sample(lobe.body, wo, choice, u);
    s.wi.z = -s.wi.z;
    return s;
}

#endif
