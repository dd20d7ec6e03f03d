// Where light starts: a light by its probability, a point on it and a direction from there, with
// all that over its density. The densities are those of shade/light.h, area and direction apart.
#ifndef ONDE_LIGHT_TRACING_EMISSION_H
#define ONDE_LIGHT_TRACING_EMISSION_H

#include "shade/light.h"
#include "shared/light_tracing.h"

typedef struct {
    real3 position;
    real3 normal;    // of the face that emits, where `surface`
    real3 direction; // of the ray that leaves, unit
    real3 power;     // of that ray
    real3 shown;     // to the camera: radiance over the density of the point, or of the direction
    mask surface;    // triangles, disks and spheres
    mask infinite;   // the environment
} Emission;

// The uniform numbers of an emission.
typedef struct {
    real2 choice; // x: which light, y: which face
    real2 point, direction;
} EmissionNumbers;

// Lambertian emission of a point of an area light; pmf is the light's probability.
INLINE Emission emit_from_face(SceneView view, natural material, Emission e, real area, real pmf,
                               EmissionNumbers u) {
    const mask two_sided =
        RECORD_NATURAL(view.materials, material, MaterialRecord, two_sided) != 0u;
    const mask back = two_sided & (u.choice.y < 0.5f);
    e.normal = choose(back, negate3(e.normal), e.normal);
    e.shown = scale3(e.shown, choose(two_sided, area * 2.0f, area) / pmf);
    e.power = scale3(e.shown, (real)(PI));
    e.direction = to_world(make_basis(e.normal), sample_cosine_hemisphere(u.direction));
    return e;
}

INLINE Emission emit_from_flat(SceneView view, natural light, mask disk, Emission e, real pmf,
                               EmissionNumbers u) {
    const real2 b = sample_flat_light(disk, u.point);
    const real3 e1 = RECORD3(view.lights, light, LightRecord, edge1);
    const real3 e2 = RECORD3(view.lights, light, LightRecord, edge2);
    const real3 corner = RECORD3(view.lights, light, LightRecord, position);
    const natural material = RECORD_NATURAL(view.lights, light, LightRecord, material);
    const real orientation = RECORD(view.lights, light, LightRecord, orientation);
    e.position = madd3(e2, b.y, madd3(e1, b.x, corner));
    e.normal = scale3(normalize3(cross3(e1, e2)), orientation);
    e.shown = material_emission(view, material, triangle_light_uv(view, light, b));
    return emit_from_face(view, material, e, RECORD(view.lights, light, LightRecord, area), pmf, u);
}

INLINE Emission emit_from_sphere(SceneView view, natural light, Emission e, real pmf,
                                 EmissionNumbers u) {
    const natural material = RECORD_NATURAL(view.lights, light, LightRecord, material);
    const real radius = RECORD(view.lights, light, LightRecord, area);
    e.normal = sample_sphere(u.point);
    e.position = madd3(e.normal, radius, RECORD3(view.lights, light, LightRecord, position));
    e.shown = RECORD3(view.materials, material, MaterialRecord, emission);
    return emit_from_face(view, material, e, radius * radius * (4.0f * PI), pmf, u);
}

INLINE Emission emit_from_point(SceneView view, natural light, Emission e, real pmf,
                                EmissionNumbers u) {
    const real3 intensity = RECORD3(view.lights, light, LightRecord, radiance);
    e.position = RECORD3(view.lights, light, LightRecord, position);
    e.direction = sample_sphere(u.direction);
    e.power = scale3(intensity, 1.0f / (pmf * PDF_SPHERE));
    return e;
}

// A ray from direction `to` through the disk that hides the scene; `shown` is the radiance over the
// density of the direction.
INLINE Emission emit_from_infinity(__global const LightTracingRecord* setup, Emission e, real3 to,
                                   EmissionNumbers u) {
    const real2 d = sample_disk(u.point);
    const Basis basis = make_basis(to);
    const real3 across = madd3(basis.t, d.y, madd3(basis.s, d.x, to));
    e.position = madd3(across, (real)(setup->radius), uniform3(setup->center));
    e.direction = negate3(to);
    e.power = scale3(e.shown, (real)(PI * setup->radius * setup->radius));
    return e;
}

INLINE Emission emit_from_direction(SceneView view, __global const LightTracingRecord* setup,
                                    natural light, Emission e, real pmf, EmissionNumbers u) {
    e.shown = scale3(RECORD3(view.lights, light, LightRecord, radiance), 1.0f / pmf);
    const real3 to = RECORD3(view.lights, light, LightRecord, position);
    e = emit_from_infinity(setup, e, to, u);
    e.shown = zero3();
    return e;
}

#if ONDE_ENVIRONMENT
INLINE Emission emit_from_environment(SceneView view, __global const LightTracingRecord* setup,
                                      Emission e, real pmf, EmissionNumbers u) {
    const real3 to = environment_sample(view, u.direction);
    const real pdf = environment_pdf(view, to);
    const real weight = choose(pdf > 0.0f, 1.0f / (pmf * pdf), (real)(0.0f));
    e.shown = scale3(environment_radiance(view, to), weight);
    return emit_from_infinity(setup, e, to, u);
}
#endif

OVERLOAD Emission choose(mask m, Emission a, Emission b) {
    Emission e = b;
    e.position = choose(m, a.position, b.position);
    e.normal = choose(m, a.normal, b.normal);
    e.direction = choose(m, a.direction, b.direction);
    e.power = choose(m, a.power, b.power);
    e.shown = choose(m, a.shown, b.shown);
    return e;
}

// The start of a ray of light. Needs at least one light.
INLINE Emission emission_sample(SceneView view, __global const LightTracingRecord* setup,
                                EmissionNumbers u, mask lanes) {
    const natural light = choose_light(view, u.choice.x);
    const natural kind = RECORD_NATURAL(view.lights, light, LightRecord, kind);
    const real pmf = RECORD(view.lights, light, LightRecord, pmf);
    const mask disk = kind == LIGHT_DISK, sphere = lanes & (kind == LIGHT_SPHERE);
    const mask flat_light = lanes & ((kind == LIGHT_TRIANGLE) | disk);
    const mask point = lanes & (kind == LIGHT_POINT), sun = lanes & (kind == LIGHT_DIRECTIONAL);
    Emission e;
    e.position = e.normal = e.direction = e.power = e.shown = zero3();
    e.surface = flat_light | sphere;
    e.infinite = lanes & (kind == LIGHT_ENVIRONMENT);
    if_any (flat_light) e = choose(flat_light, emit_from_flat(view, light, disk, e, pmf, u), e);
    if_any (sphere) e = choose(sphere, emit_from_sphere(view, light, e, pmf, u), e);
    if_any (point) e = choose(point, emit_from_point(view, light, e, pmf, u), e);
    if_any (sun) e = choose(sun, emit_from_direction(view, setup, light, e, pmf, u), e);
#if ONDE_ENVIRONMENT
    if_any (e.infinite) e = choose(e.infinite, emit_from_environment(view, setup, e, pmf, u), e);
#endif
    return e;
}

#endif
