// What every type of light gives and takes. Densities are per solid angle at the point that
// receives the light, without the choice of the light. A type `name` is a file of this folder and
// a line of LIGHT_TYPES in shared/scene.h:
//   name_light_sample(view, light, from, u)               a direction from a point to the light
//   name_light_pdf(view, light, from, direction, t, s)    the density with which that would have
//       been the ray from `from` that hit the light's surface `s` at distance t; 0 if it has none
//   name_light_emit(view, setup, light, pmf, u)           a ray that leaves it; pmf: of its choice
#ifndef ONDE_SHADE_LIGHTS_LIGHT_TYPE_H
#define ONDE_SHADE_LIGHTS_LIGHT_TYPE_H

#include "shade/material.h"
#include "shared/light_tracing.h"

#define INFINITE_DISTANCE 1e30f

// A point that is to be lit.
typedef struct {
    real3 position;
    real3 normal; // unit: what comes from below counts nothing; 0: all light counts
} Receiver;

INLINE Receiver receiver_at(real3 position, real3 normal) {
    Receiver at;
    at.position = position;
    at.normal = normal;
    return at;
}

typedef struct {
    real3 direction; // unit, to the light
    real distance;   // INFINITE_DISTANCE for light from infinity
    real3 radiance;  // arriving, unoccluded; for delta lights, irradiance at unit density
    real pdf;        // of the direction; 1 for delta lights
    mask delta;      // points and directions, which no ray can hit
    mask valid;
    natural group; // of lights; light.h finds it, where films ask for groups
} LightSample;

// The start of a ray of light, over the density of all that was chosen.
typedef struct {
    real3 position;
    real3 normal;    // of the face that emits, where `surface`
    real lift;       // likewise; see Surface
    real3 direction; // of the ray that leaves, unit
    real3 power;     // of that ray
    real3 shown;     // to the camera: radiance over the density of the point, or of the direction
    mask surface;    // it starts on a surface that a camera can see
    mask infinite;   // it comes from the environment
} Emission;

// The uniform numbers of an emission.
typedef struct {
    real2 choice; // x: which light, y: which face
    real2 point, direction;
} EmissionNumbers;

// A number of a light's own record: LIGHT_FIELD(view, light, sphere.radius).
#define LIGHT_FIELD(view, light, field) RECORD(view.lights, light, LightRecord, as.field)
#define LIGHT_FIELD3(view, light, field) RECORD3(view.lights, light, LightRecord, as.field)
#define LIGHT_MATERIAL(view, light) RECORD_NATURAL(view.lights, light, LightRecord, material)

// Of lights without texture coordinates.
INLINE UvSets no_uvs(void) {
    return same_in_all_sets(make2((real)(0.0f), (real)(0.0f)));
}
INLINE real light_opacity(SceneView view, natural light) {
    return material_opacity(view, LIGHT_MATERIAL(view, light), no_uvs(), (real)(1.0f));
}

OVERLOAD LightSample choose(mask m, LightSample a, LightSample b) {
    LightSample s;
    s.direction = choose(m, a.direction, b.direction);
    s.distance = choose(m, a.distance, b.distance);
    s.radiance = choose(m, a.radiance, b.radiance);
    s.pdf = choose(m, a.pdf, b.pdf);
    s.delta = choose(m, a.delta, b.delta);
    s.valid = choose(m, a.valid, b.valid);
    s.group = choose(m, a.group, b.group);
    return s;
}
OVERLOAD Emission choose(mask m, Emission a, Emission b) {
    Emission e;
    e.position = choose(m, a.position, b.position);
    e.normal = choose(m, a.normal, b.normal);
    e.lift = choose(m, a.lift, b.lift);
    e.direction = choose(m, a.direction, b.direction);
    e.power = choose(m, a.power, b.power);
    e.shown = choose(m, a.shown, b.shown);
    e.surface = choose(m, a.surface, b.surface);
    e.infinite = choose(m, a.infinite, b.infinite);
    return e;
}

INLINE LightSample no_light_sample(void) {
    LightSample s;
    s.direction = s.radiance = zero3();
    s.distance = (real)(0.0f);
    s.pdf = (real)(1.0f);
    s.delta = s.valid = (mask)(0);
    s.group = (natural)(0u);
    return s;
}
INLINE Emission no_emission(void) {
    Emission e;
    e.position = e.normal = e.direction = e.power = e.shown = zero3();
    e.lift = (real)(0.0f);
    e.surface = e.infinite = (mask)(0);
    return e;
}

// The density per solid angle of a point of a surface, `cosine` to the ray at distance t.
INLINE real area_pdf(real t, real cosine, real area) {
    return t * t / (max_real(fabs(cosine), (real)(1e-9f)) * area);
}

// Lambertian emission of an area light from the point and normal of `e`, where it has radiance
// `radiance`.
INLINE Emission emit_from_face(SceneView view, natural material, Emission e, real3 radiance,
                               real area, real pmf, EmissionNumbers u) {
    const mask two_sided =
        RECORD_NATURAL(view.materials, material, MaterialRecord, two_sided) != 0u;
    const mask back = two_sided & (u.choice.y < 0.5f);
    e.normal = choose(back, negate3(e.normal), e.normal);
    e.shown = scale3(radiance, choose(two_sided, area * 2.0f, area) / pmf);
    e.power = scale3(e.shown, (real)(PI));
    e.direction = to_world(make_basis(e.normal), sample_cosine_hemisphere(u.direction));
    e.surface = (mask)(pmf > 0.0f);
    return e;
}

// A ray from direction `to` through the disk that hides the scene; `weight` is the radiance over
// the density of the direction.
INLINE Emission emit_from_infinity(__global const LightTracingRecord* setup, real3 to, real3 weight,
                                   EmissionNumbers u) {
    const real2 d = sample_disk(u.point);
    const Basis basis = make_basis(to);
    const real3 across = madd3(basis.t, d.y, madd3(basis.s, d.x, to));
    Emission e = no_emission();
    e.position = madd3(across, (real)(setup->radius), uniform3(setup->center));
    e.direction = negate3(to);
    e.power = scale3(weight, (real)(PI * setup->radius * setup->radius));
    return e;
}

#endif
