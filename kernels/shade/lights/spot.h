// A point that shines into a cone, and less between an inner cone and its rim.
#ifndef ONDE_SHADE_LIGHTS_SPOT_H
#define ONDE_SHADE_LIGHTS_SPOT_H

#include "shade/lights/point.h"

// The share of its intensity in directions of that cosine to its axis: the square of a line from
// the rim, as KHR_lights_punctual advises.
INLINE real spot_share(SceneView view, natural light, real cosine) {
    const real inside = LIGHT_FIELD(view, light, spot.opening) - (1.0f - cosine);
    const real line = clamp_real(inside * LIGHT_FIELD(view, light, spot.steepness), 0.0f, 1.0f);
    return line * line;
}

INLINE LightSample spot_light_sample(SceneView view, natural light, real3 from, real2 u) {
    LightSample s = sample_point(LIGHT_FIELD3(view, light, spot.position),
                                 LIGHT_FIELD3(view, light, spot.intensity), from);
    const real share =
        spot_share(view, light, dot3(LIGHT_FIELD3(view, light, spot.back), s.direction));
    s.radiance = scale3(s.radiance, share);
    s.valid = share > 0.0f;
    return s;
}
INLINE real spot_light_pdf(SceneView view, natural light, real3 from, real3 direction, real t,
                           Surface s) {
    return (real)(0.0f);
}
INLINE Emission spot_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                natural light, real pmf, EmissionNumbers u) {
    const real opening = LIGHT_FIELD(view, light, spot.opening);
    const Basis basis = make_basis(negate3(LIGHT_FIELD3(view, light, spot.back)));
    const real3 way = sample_cone(u.direction, opening);
    const real weight = spot_share(view, light, way.z) / (pmf * pdf_cone(opening));
    Emission e = no_emission();
    e.position = LIGHT_FIELD3(view, light, spot.position);
    e.direction = to_world(basis, way);
    e.power = scale3(LIGHT_FIELD3(view, light, spot.intensity), weight);
    return e;
}

#endif
