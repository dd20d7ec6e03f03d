// Choosing a light, a point on it, and the density of that choice. Densities are per solid angle
// at the point that receives the light, and include the choice of the light.
#ifndef ONDE_SHADE_LIGHT_H
#define ONDE_SHADE_LIGHT_H

#include "shade/environment.h"
#include "shade/material.h"

#define INFINITE_DISTANCE 1e30f

typedef struct {
    real3 direction; // unit, to the light
    real distance;   // INFINITE_DISTANCE for light from infinity
    real3 radiance;  // arriving, unoccluded; for delta lights, irradiance at unit density
    real pdf;        // of the direction, with the choice; the choice alone for delta lights
    mask delta;      // points and directions, which no ray can hit
    mask valid;
} LightSample;

// A light by its probability (Vose 1991), from one uniform number.
INLINE natural choose_light(SceneView view, real u) {
    const float count = (float)view.frame->light_count;
    const real scaled = u * count;
    const real whole = min_real(floor(scaled), (real)(count - 1.0f));
    const natural i = as_natural(to_integer(whole));
    const mask stays = scaled - whole < RECORD(view.lights, i, LightRecord, alias_below);
    return choose(stays, i, RECORD_NATURAL(view.lights, i, LightRecord, alias));
}

// The texture coordinates of a point of a triangle light, by the weights of corners 1 and 2.
INLINE real2 triangle_light_uv(SceneView view, natural light, real2 b) {
    real2 uv = make2((real)(0.0f), (real)(0.0f));
#if ONDE_TEXTURES
    const natural surface = RECORD_NATURAL(view.lights, light, LightRecord, surface);
    const real w = 1.0f - b.x - b.y;
    uv.x = fma(RECORD(view.surfaces, surface, SurfaceRecord, uv[0]), w,
               fma(RECORD(view.surfaces, surface, SurfaceRecord, uv[2]), b.x,
                   RECORD(view.surfaces, surface, SurfaceRecord, uv[4]) * b.y));
    uv.y = fma(RECORD(view.surfaces, surface, SurfaceRecord, uv[1]), w,
               fma(RECORD(view.surfaces, surface, SurfaceRecord, uv[3]), b.x,
                   RECORD(view.surfaces, surface, SurfaceRecord, uv[5]) * b.y));
#endif
    return uv;
}

// Where on a light spanned by two edges: in the triangle, or in the disk of two radii.
INLINE real2 sample_flat_light(mask disk, real2 u) {
    const real2 corner = sample_triangle(u), polar = sample_disk(u);
    return make2(choose(disk, polar.x, corner.x), choose(disk, polar.y, corner.y));
}

INLINE LightSample sample_flat_light_from(SceneView view, natural light, mask disk, real3 from,
                                          real2 u) {
    const real2 b = sample_flat_light(disk, u);
    const real3 e1 = RECORD3(view.lights, light, LightRecord, edge1);
    const real3 e2 = RECORD3(view.lights, light, LightRecord, edge2);
    const real3 corner = RECORD3(view.lights, light, LightRecord, position);
    const real3 to = sub3(madd3(e2, b.y, madd3(e1, b.x, corner)), from);
    const real distance2 = dot3(to, to);
    LightSample s;
    s.distance = sqrt(distance2);
    s.direction = scale3(to, 1.0f / s.distance);
    const real orientation = RECORD(view.lights, light, LightRecord, orientation);
    const real facing = -dot3(normalize3(cross3(e1, e2)), s.direction) * orientation;
    const natural material = RECORD_NATURAL(view.lights, light, LightRecord, material);
    s.radiance = material_emission(view, material, triangle_light_uv(view, light, b));
    const real cosine = fabs(facing);
    s.pdf = distance2 /
            max_real(cosine * RECORD(view.lights, light, LightRecord, area), (real)(1e-30f));
    s.valid = (cosine > 1e-6f) & material_emits(view, material, facing > 0.0f);
    return s;
}

// 1 - cos of the half angle under which a sphere is seen, without cancellation; 2 from inside.
INLINE real sphere_opening(real distance2, real radius) {
    const real sine2 = radius * radius / max_real(distance2, (real)(1e-30f));
    const real cosine = safe_sqrt(1.0f - sine2);
    return choose(sine2 >= 1.0f, (real)(2.0f), sine2 / (1.0f + cosine));
}

INLINE LightSample sample_sphere_light(SceneView view, natural light, real3 from, real2 u) {
    const real radius = RECORD(view.lights, light, LightRecord, area);
    const real3 to = sub3(RECORD3(view.lights, light, LightRecord, position), from);
    const real distance2 = dot3(to, to);
    const real opening = sphere_opening(distance2, radius);
    const mask inside = opening == 2.0f;
    const real3 axis = normalize3(choose(distance2 > 0.0f, to, splat3((real)(1.0f))));
    LightSample s;
    s.direction = to_world(make_basis(axis), sample_cone(u, opening));
    const real along = dot3(to, s.direction);
    const real3 across = madd3(s.direction, -along, to);
    const real half_chord = safe_sqrt(radius * radius - dot3(across, across));
    s.distance = choose(inside, along + half_chord, along - half_chord);
    const natural material = RECORD_NATURAL(view.lights, light, LightRecord, material);
    s.radiance = RECORD3(view.materials, material, MaterialRecord, emission);
    s.pdf = pdf_cone(opening);
    s.valid = (s.distance > 0.0f) & material_emits(view, material, !inside);
    return s;
}

INLINE LightSample sample_delta_light(SceneView view, natural light, mask point, real3 from) {
    const real3 position = RECORD3(view.lights, light, LightRecord, position);
    const real3 strength = RECORD3(view.lights, light, LightRecord, radiance);
    const real3 to = sub3(position, from);
    const real distance2 = max_real(dot3(to, to), (real)(1e-30f));
    LightSample s;
    s.distance = choose(point, sqrt(distance2), (real)(INFINITE_DISTANCE));
    s.direction = choose(point, scale3(to, 1.0f / s.distance), position);
    s.radiance = choose(point, scale3(strength, 1.0f / distance2), strength);
    s.pdf = (real)(1.0f);
    s.valid = (mask)(s.distance > 0.0f);
    return s;
}

OVERLOAD LightSample choose(mask m, LightSample a, LightSample b) {
    LightSample s;
    s.direction = choose(m, a.direction, b.direction);
    s.distance = choose(m, a.distance, b.distance);
    s.radiance = choose(m, a.radiance, b.radiance);
    s.pdf = choose(m, a.pdf, b.pdf);
    s.delta = choose(m, a.delta, b.delta);
    s.valid = choose(m, a.valid, b.valid);
    return s;
}

// One light, and a direction to it from a point. Uniform numbers: `choice` for the light.
INLINE LightSample light_sample(SceneView view, real3 from, real choice, real2 u, mask lanes) {
    const natural light = choose_light(view, choice);
    const natural kind = RECORD_NATURAL(view.lights, light, LightRecord, kind);
    const mask disk = kind == LIGHT_DISK;
    const mask flat_light = lanes & ((kind == LIGHT_TRIANGLE) | disk);
    const mask sphere = lanes & (kind == LIGHT_SPHERE);
    const mask point = lanes & (kind == LIGHT_POINT);
    const mask delta = point | (lanes & (kind == LIGHT_DIRECTIONAL));
    const mask infinite = lanes & (kind == LIGHT_ENVIRONMENT);
    LightSample s;
    s.direction = zero3();
    s.distance = (real)(0.0f);
    s.radiance = zero3();
    s.pdf = (real)(1.0f);
    s.delta = delta;
    s.valid = lanes & !lanes;
    if_any (flat_light)
        s = choose(flat_light, sample_flat_light_from(view, light, disk, from, u), s);
    if_any (sphere) s = choose(sphere, sample_sphere_light(view, light, from, u), s);
    if_any (delta) s = choose(delta, sample_delta_light(view, light, point, from), s);
#if ONDE_ENVIRONMENT
    if_any (infinite) {
        LightSample e;
        e.direction = environment_sample(view, u);
        e.distance = (real)(INFINITE_DISTANCE);
        e.radiance = environment_radiance(view, e.direction);
        e.pdf = environment_pdf(view, e.direction);
        e.valid = e.pdf > 0.0f;
        s = choose(infinite, e, s);
    }
#endif
    s.delta = delta;
    s.pdf *= RECORD(view.lights, light, LightRecord, pmf);
    return s;
}

// The density with which light_sample would have produced the ray from `from` that hit the
// emitting surface `s` at distance t. Lanes whose surface is no light get 0.
INLINE real light_pdf(SceneView view, real3 from, real3 direction, real t, Surface s) {
    const mask listed = s.light < LIGHT_UNLISTED;
    const natural light = choose(listed, s.light, (natural)(0u));
    const mask sphere =
        listed & (RECORD_NATURAL(view.lights, light, LightRecord, kind) == LIGHT_SPHERE);
    const real area = RECORD(view.lights, light, LightRecord, area);
    const real cosine = max_real(fabs(dot3(s.geometric, direction)), (real)(1e-9f));
    real pdf = t * t / (cosine * area);
    if_any (sphere) {
        const real3 to = sub3(RECORD3(view.lights, light, LightRecord, position), from);
        pdf = choose(sphere, pdf_cone(sphere_opening(dot3(to, to), area)), pdf);
    }
    pdf *= RECORD(view.lights, light, LightRecord, pmf);
    return choose(listed, pdf, (real)(0.0f));
}

// The density of an environment direction, with the choice of the environment among the lights.
INLINE real environment_light_pdf(SceneView view, real3 direction) {
    const uint light = view.frame->environment_light;
    if (light == NO_INDEX) return (real)(0.0f);
    return environment_pdf(view, direction) * view.lights[light].pmf;
}

#endif
