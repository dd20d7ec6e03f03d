// A point of the same intensity in all directions.
#ifndef ONDE_SHADE_LIGHTS_POINT_H
#define ONDE_SHADE_LIGHTS_POINT_H

#include "shade/lights/light_type.h"

// From `from` to a point that shines with `intensity`.
INLINE LightSample sample_point(real3 position, real3 intensity, real3 from) {
    const real3 to = sub3(position, from);
    const real distance2 = max_real(dot3(to, to), (real)(1e-30f));
    LightSample s = no_light_sample();
    s.distance = sqrt(distance2);
    s.direction = scale3(to, 1.0f / s.distance);
    s.radiance = scale3(intensity, 1.0f / distance2);
    s.delta = s.valid = s.distance > 0.0f;
    return s;
}

INLINE LightSample point_light_sample(SceneView view, natural light, real3 from, real2 u) {
    return sample_point(LIGHT_FIELD3(view, light, point.position),
                        LIGHT_FIELD3(view, light, point.intensity), from);
}
INLINE real point_light_pdf(SceneView view, natural light, real3 from, real3 direction, real t,
                            Surface s) {
    return (real)(0.0f);
}
INLINE Emission point_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                 natural light, real pmf, EmissionNumbers u) {
    Emission e = no_emission();
    e.position = LIGHT_FIELD3(view, light, point.position);
    e.direction = sample_sphere(u.direction);
    e.power = scale3(LIGHT_FIELD3(view, light, point.intensity), 1.0f / (pmf * PDF_SPHERE));
    return e;
}

#endif
