// Light from a disk at infinity, of the same radiance everywhere on it.
#ifndef ONDE_SHADE_LIGHTS_SUN_H
#define ONDE_SHADE_LIGHTS_SUN_H

#include "shade/camera_motion.h"
#include "shade/environment.h"
#include "shade/lights/light_type.h"

INLINE LightSample sun_light_sample(SceneView view, natural light, real3 from, real2 u) {
    const real opening = LIGHT_FIELD(view, light, sun.opening);
    LightSample s = no_light_sample();
    s.direction =
        to_world(make_basis(LIGHT_FIELD3(view, light, sun.to_light)), sample_cone(u, opening));
    s.distance = (real)(INFINITE_DISTANCE);
    s.radiance = LIGHT_FIELD3(view, light, sun.radiance);
    s.pdf = pdf_cone(opening);
    s.valid = s.pdf > 0.0f;
    return s;
}
INLINE real sun_light_pdf(SceneView view, natural light, real3 from, real3 direction, real t,
                          Surface s) {
    return (real)(0.0f);
}

// What comes of it from a direction, and the density with which sun_light_sample takes that. By
// the distance between unit vectors, as cosines near 1 tell nothing of small angles.
INLINE FarLight sun_look(SceneView view, natural light, real3 direction) {
    const real opening = LIGHT_FIELD(view, light, sun.opening);
    const real3 off = sub3(direction, LIGHT_FIELD3(view, light, sun.to_light));
    const mask seen = dot3(off, off) <= 2.0f * opening;
    FarLight far;
    far.radiance = choose(seen, LIGHT_FIELD3(view, light, sun.radiance), zero3());
    far.pdf = choose(seen, pdf_cone(opening), (real)(0.0f));
    return far;
}

INLINE Emission sun_light_emit(SceneView view, __global const LightTracingRecord* setup,
                               natural light, real pmf, EmissionNumbers u) {
    const real opening = LIGHT_FIELD(view, light, sun.opening);
    const real3 to = to_world(make_basis(LIGHT_FIELD3(view, light, sun.to_light)),
                              sample_cone(u.direction, opening));
    const real density = pmf * pdf_cone(opening);
    const real3 shown = scale3(LIGHT_FIELD3(view, light, sun.radiance), 1.0f / density);
    Emission e = emit_from_infinity(setup, to, shown, u);
    e.shown = shown;
    if (view.frame->orthographic) { // it sees one direction, which no other way would find
        const FarLight far = sun_look(view, light, view_axis(view));
        e.shown = scale3(far.radiance, 1.0f / pmf);
    }
    e.infinite = (mask)(pmf > 0.0f);
    return e;
}

#endif
