// The environment as a light.
#ifndef ONDE_SHADE_LIGHTS_ENVIRONMENT_H
#define ONDE_SHADE_LIGHTS_ENVIRONMENT_H

#include "shade/camera_motion.h"
#include "shade/environment.h"
#include "shade/lights/light_type.h"

// By the tables of `which`.
INLINE LightSample sample_environment_light(SceneView view, real2 u, uint which) {
    LightSample s = no_light_sample();
    s.direction = environment_sample(view, u, which);
    s.distance = (real)(INFINITE_DISTANCE);
    const FarLight far = environment_look(view, s.direction, which);
    s.radiance = far.radiance;
    s.pdf = far.pdf;
    s.valid = s.pdf > 0.0f;
    return s;
}

// For estimators that follow BSDFs from every point that they light.
INLINE LightSample environment_light_sample(SceneView view, natural light, real3 from, real2 u) {
    return sample_environment_light(view, u, MAP_COMPENSATED);
}
INLINE real environment_light_pdf(SceneView view, natural light, real3 from, real3 direction,
                                  real t, Surface s) {
    return (real)(0.0f);
}
INLINE Emission environment_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                       natural light, real pmf, EmissionNumbers u) {
    const real3 to = environment_sample(view, u.direction, MAP_WHOLE);
    const FarLight far = environment_look(view, to, MAP_WHOLE);
    const real weight = choose(far.pdf > 0.0f, 1.0f / (pmf * far.pdf), (real)(0.0f));
    const real3 shown = scale3(far.radiance, weight);
    Emission e = emit_from_infinity(setup, to, shown, u);
    e.shown = shown;
    if (view.frame->orthographic) { // it sees one direction, which no other way would find
        const real3 ahead = view_axis(view);
        e.shown = scale3(environment_radiance(view, ahead), 1.0f / pmf);
    }
    e.infinite = (mask)(pmf > 0.0f);
    return e;
}

#endif
