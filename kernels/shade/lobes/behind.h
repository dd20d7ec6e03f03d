// Light that a body scatters to its far side, as leaves and paper do
// (KHR_materials_diffuse_transmission): Lambert's reflector, below.
#ifndef ONDE_SHADE_LOBES_BEHIND_H
#define ONDE_SHADE_LOBES_BEHIND_H

#include "shade/lobes/diffuse.h"

typedef DiffuseLobe BehindLobe;

INLINE BehindLobe behind_load(SceneView view, MaterialPoint m) {
    m.color = m.behind_color;
    m.behind = 1.0f - m.behind; // the share that is left to the body
    return diffuse_load(view, m);
}
INLINE real behind_weight(BehindLobe lobe, MaterialPoint m) {
    return diffuse_weight(lobe, m);
}
INLINE mask behind_is_smooth(BehindLobe lobe) {
    return (mask)(0);
}
INLINE LobeValue behind_eval(BehindLobe lobe, real3 wo, real3 wi, mask lanes) {
    return diffuse_eval(lobe, wo, make3(wi.x, wi.y, -wi.z), lanes);
}
INLINE LobeSample behind_sample(BehindLobe lobe, real3 wo, real choice, real2 u) {
    LobeSample s = diffuse_sample(lobe, wo, choice, u);
    s.wi.z = -s.wi.z;
    return s;
}

#endif
