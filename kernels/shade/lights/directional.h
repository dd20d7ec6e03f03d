// Light from one direction at infinity.
#ifndef ONDE_SHADE_LIGHTS_DIRECTIONAL_H
#define ONDE_SHADE_LIGHTS_DIRECTIONAL_H

#include "shade/lights/light_type.h"

INLINE LightSample directional_light_sample(SceneView view, natural light, real3 from, real2 u) {
    LightSample s = no_light_sample();
    s.distance = (real)(INFINITE_DISTANCE);
    s.direction = LIGHT_FIELD3(view, light, directional.to_light);
    s.radiance = LIGHT_FIELD3(view, light, directional.irradiance);
    s.delta = s.valid = s.distance > 0.0f;
    return s;
}
INLINE real directional_light_pdf(SceneView view, natural light, real3 from, real3 direction,
                                  real t, Surface s) {
    return (real)(0.0f);
}
INLINE Emission directional_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                       natural light, real pmf, EmissionNumbers u) {
    const real3 irradiance = LIGHT_FIELD3(view, light, directional.irradiance);
    return emit_from_infinity(setup, LIGHT_FIELD3(view, light, directional.to_light),
                              scale3(irradiance, 1.0f / pmf), u);
}

#endif
