// A sphere that emits, uniform over the cone under which it is seen.
#ifndef ONDE_SHADE_LIGHTS_SPHERE_H
#define ONDE_SHADE_LIGHTS_SPHERE_H

#include "shade/lights/light_type.h"

// 1 - cos of the half angle under which a sphere is seen, without cancellation; 2 from inside.
INLINE real sphere_opening(real distance2, real radius) {
    const real sine2 = radius * radius / max_real(distance2, (real)(1e-30f));
    const real cosine = safe_sqrt(1.0f - sine2);
    return choose(sine2 >= 1.0f, (real)(2.0f), sine2 / (1.0f + cosine));
}

INLINE LightSample sphere_light_sample(SceneView view, natural light, real3 from, real2 u) {
    const real radius = LIGHT_FIELD(view, light, sphere.radius);
    const real3 to = sub3(LIGHT_FIELD3(view, light, sphere.center), from);
    const real distance2 = dot3(to, to);
    const real opening = sphere_opening(distance2, radius);
    const mask inside = opening == 2.0f;
    const real3 axis = normalize3(choose(distance2 > 0.0f, to, splat3((real)(1.0f))));
    LightSample s = no_light_sample();
    s.direction = to_world(make_basis(axis), sample_cone(u, opening));
    const real along = dot3(to, s.direction);
    const real3 across = madd3(s.direction, -along, to);
    const real half_chord = safe_sqrt(radius * radius - dot3(across, across));
    s.distance = choose(inside, along + half_chord, along - half_chord);
    const natural material = LIGHT_MATERIAL(view, light);
    s.radiance = scale3(RECORD3(view.materials, material, MaterialRecord, emission),
                        light_opacity(view, light));
    s.pdf = pdf_cone(opening);
    s.valid = (s.distance > 0.0f) & material_emits(view, material, !inside);
    return s;
}
INLINE real sphere_light_pdf(SceneView view, natural light, real3 from, real3 direction, real t,
                             Surface s) {
    const real3 to = sub3(LIGHT_FIELD3(view, light, sphere.center), from);
    return pdf_cone(sphere_opening(dot3(to, to), LIGHT_FIELD(view, light, sphere.radius)));
}
INLINE Emission sphere_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                  natural light, real pmf, EmissionNumbers u) {
    const natural material = LIGHT_MATERIAL(view, light);
    const real radius = LIGHT_FIELD(view, light, sphere.radius);
    const real3 radiance = scale3(RECORD3(view.materials, material, MaterialRecord, emission),
                                  light_opacity(view, light));
    Emission e = no_emission();
    e.normal = sample_sphere(u.point);
    e.position = madd3(e.normal, radius, LIGHT_FIELD3(view, light, sphere.center));
    e.lift = origin_lift(e.position, radius);
    return emit_from_face(view, material, e, radiance, radius * radius * (4.0f * PI), pmf, u);
}

#endif
