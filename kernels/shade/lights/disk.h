// An elliptic disk that emits, uniform over its area. It has no texture coordinates.
#ifndef ONDE_SHADE_LIGHTS_DISK_H
#define ONDE_SHADE_LIGHTS_DISK_H

#include "shade/lights/flat.h"

INLINE FlatLight disk_light(SceneView view, natural light) {
    const FlatLight f = LOAD_FLAT(view, light, disk, center, radius1, radius2);
    return f;
}

INLINE LightSample disk_light_sample(SceneView view, natural light, real3 from, real2 u) {
    return flat_sample(view, disk_light(view, light), sample_disk(u), no_uvs(),
                       light_opacity(view, light), from);
}
INLINE real disk_light_pdf(SceneView view, natural light, real3 from, real3 direction, real t,
                           Surface s) {
    return area_pdf(t, dot3(s.geometric, direction), LIGHT_FIELD(view, light, disk.area));
}
INLINE Emission disk_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                natural light, real pmf, EmissionNumbers u) {
    return flat_emit(view, disk_light(view, light), sample_disk(u.point), no_uvs(),
                     light_opacity(view, light), pmf, u);
}

#endif
