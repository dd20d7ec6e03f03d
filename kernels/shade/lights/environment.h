// The environment as a light.
#ifndef ONDE_SHADE_LIGHTS_ENVIRONMENT_H
#define ONDE_SHADE_LIGHTS_ENVIRONMENT_H

#include "shade/environment.h"
#include "shade/lights/light_type.h"

INLINE LightSample environment_light_sample(SceneView view, natural light, real3 from, real2 u) {
    LightSample s = no_light_sample();
    s.direction = environment_sample(view, u);
    s.distance = (real)(INFINITE_DISTANCE);
    s.radiance = environment_radiance(view, s.direction);
    s.pdf = environment_pdf(view, s.direction);
    s.valid = s.pdf > 0.0f;
    return s;
}
INLINE real environment_light_pdf(SceneView view, natural light, real3 from, real3 direction,
                                  real t, Surface s) {
    return (real)(0.0f);
}
INLINE Emission environment_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                       natural light, real pmf, EmissionNumbers u) {
    const real3 to = environment_sample(view, u.direction);
    const real pdf = environment_pdf(view, to);
    const real weight = choose(pdf > 0.0f, 1.0f / (pmf * pdf), (real)(0.0f));
    const real3 shown = scale3(environment_radiance(view, to), weight);
    Emission e = emit_from_infinity(setup, to, shown, u);
    e.shown = shown;
    e.infinite = (mask)(pmf > 0.0f);
    return e;
}

#endif
