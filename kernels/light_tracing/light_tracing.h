// The light-tracing estimator: paths that start at the lights and follow BSDFs as the path tracer's
// do, each vertex connected to the camera. It knows nothing of queues, waves or films; it returns
// what should happen next (light for a pixel, the next ray), and the schedulers store or loop on
// it.
//
// Particles carry power, not radiance: the BSDF is used with its directions exchanged, which takes
// a factor for shading normals and one for refraction (Veach 1997, sections 5.2 and 5.3).
#ifndef ONDE_LIGHT_TRACING_LIGHT_TRACING_H
#define ONDE_LIGHT_TRACING_LIGHT_TRACING_H

#define ONDE_ADJOINT 1
#include "light_tracing/connection.h"
#include "shade/light.h"
#include "shade/passing.h"

// Named dimension pairs of a light path: its emission, then four pairs per vertex, the first of
// which is the light itself.
#define LIGHT_DIMENSION_CHOICE 0u // x: which light, y: which face
#define LIGHT_DIMENSION_POINT 1u
#define LIGHT_DIMENSION_DIRECTION 2u
#define LIGHT_DIMENSION_VERTICES 3u
#define VERTEX_DIMENSION_PIXEL 0u // of those whose filters reach the point
#define VERTEX_DIMENSION_LENS 1u
#define VERTEX_DIMENSION_DIRECTION 2u
#define VERTEX_DIMENSION_CHOICE 3u // x: which lobe, y: roulette
#define DIMENSIONS_PER_VERTEX 4u

INLINE uint vertex_dimension(uint vertex, uint which) {
    return LIGHT_DIMENSION_VERTICES + vertex * DIMENSIONS_PER_VERTEX + which;
}

// Which of the surfaces that let rays pass ends the ray to a bounce; none of the above.
INLINE uint passing_dimension(uint bounce) {
    return 0x40000000u + bounce;
}

#if ONDE_DISPERSION
    #define LIGHT_WAVE WAVE_COLUMNS
#else
    #define LIGHT_WAVE NO_COLUMNS
#endif
#if ONDE_SHUTTER
    #define LIGHT_TIME TIME_COLUMNS
#else
    #define LIGHT_TIME NO_COLUMNS
#endif
#define LIGHT_STATE(VECTOR, REAL, NATURAL)                                                         \
    LIGHT_PATH_COLUMNS(VECTOR, REAL, NATURAL)                                                      \
    LIGHT_TIME(VECTOR, REAL, NATURAL) LIGHT_WAVE(VECTOR, REAL, NATURAL)
COLUMNS_TYPE(LightPath, LIGHT_STATE);

typedef struct {
    Connection connection;
    LightPath next;
    mask alive; // whether `next` goes on
} LightVertex;

// Random numbers of path number sample * paths_per_sample + index: all paths of a frame share one
// sequence, which spreads them evenly over the lights and their directions.
INLINE Sampler light_sampler(__global const FrameRecord* frame, natural index, natural sample) {
    const natural paths_per_sample = (natural)(frame->width * frame->height);
    const natural before = sample * paths_per_sample;
    const natural number = before + index;
    const natural carry = one_for(number < before);
    return sampler_start(mul_hi(sample, paths_per_sample) + carry, number, frame->seed);
}

// Light from infinity seen by the camera: a ray from the lens out of the scene.
INLINE Connection connect_infinity(SceneView view, Emission e, real2 lens, real2 pixel) {
    __global const FrameRecord* frame = view.frame;
    CameraLink link = link_along(view, negate3(e.direction), lens);
    if (frame->orthographic) link = link_of_screen(view, lens);
    Connection c = connect_film(frame, link, e.position, scale3(e.shown, link.importance), pixel,
                                e.infinite & link.valid);
    c.origin = link.camera;
    c.direction = negate3(link.direction);
    c.distance = choose(c.distance > 0.0f, (real)(INFINITE_DISTANCE), c.distance);
    return c;
}

// What the camera sees of the light itself.
INLINE Connection connect_light(SceneView view, Emission e, Sampler sampler) {
    const real2 pixel = sampler_pair(sampler, vertex_dimension(0, VERTEX_DIMENSION_PIXEL));
    const real2 lens = sampler_pair(sampler, vertex_dimension(0, VERTEX_DIMENSION_LENS));
    Connection c = no_connection();
    if_any (e.surface) {
        const CameraLink link = link_of_point(view, e.position, lens);
        const real cosine = dot3(e.normal, link.direction);
        const real3 origin = offset_origin(e.position, e.normal, e.lift);
        c = connect_film(view.frame, link, origin, scale3(e.shown, cosine * link.importance), pixel,
                         e.surface & link.valid & (cosine > 0.0f));
    }
    if (HAS_FAR_LIGHT) {
        if_any (e.infinite) {
            c = choose(e.infinite, connect_infinity(view, e, lens, pixel), c);
        }
    }
    return c;
}

// The start of the paths in `lanes`: the light as a vertex, and the ray that leaves it.
OUTLINED LightVertex light_start(SceneView view, __global const LightTracingRecord* setup,
                                 Sampler sampler, mask lanes) {
    EmissionNumbers u;
    u.choice = sampler_pair(sampler, LIGHT_DIMENSION_CHOICE);
    u.point = sampler_pair(sampler, LIGHT_DIMENSION_POINT);
    u.direction = sampler_pair(sampler, LIGHT_DIMENSION_DIRECTION);
    LightVertex result;
#if ONDE_SHUTTER
    result.next.time = view.bvh.time = sampler_pair(sampler, DIMENSION_TIME).x;
#endif
    const Emission e = light_emit(view, setup, u, lanes);
    result.connection = connect_light(view, e, sampler);
    result.next.origin = choose(e.surface, offset_origin(e.position, e.normal, e.lift), e.position);
    result.next.direction = e.direction;
    result.next.emitted = e.power;
    result.next.throughput = splat3((real)(1.0f));
#if ONDE_DISPERSION
    result.next.dispersed = (natural)(0u);
#endif
    result.alive = lanes & nonzero3(e.power);
    if (view.frame->max_depth < 2) result.alive = lanes & !lanes;
    return result;
}

// The BSDF's factor for particles that come from v.wo and leave along wi, in world direction d.
INLINE real particle_factor(Vertex v, real3 incoming, real3 wi, real3 d) {
    const real3 true_normal = v.surface.geometric, normal = v.surface.normal;
    const real above = fabs(dot3(incoming, normal) * dot3(d, true_normal));
    const real below = fabs(dot3(incoming, true_normal) * dot3(d, normal));
    const real bent = above / max_real(below, (real)(1e-9f));
    const real eta = bsdf_eta(v.bsdf);
    return choose(wi.z < 0.0f, bent * eta * eta, bent);
}

INLINE Connection connect_surface(SceneView view, LightPath path, Vertex v, Sampler sampler,
                                  uint vertex, mask lanes) {
    const real2 lens = sampler_pair(sampler, vertex_dimension(vertex, VERTEX_DIMENSION_LENS));
    const CameraLink link = link_of_point(view, v.surface.position, lens);
    const real3 wi = to_local(v.basis, link.direction);
    real3 f = bsdf_eval(v.bsdf, v.wo, wi).value;
#if ONDE_DISPERSION
    f = mul3(f, wave_share(v, wi, path.dispersed));
#endif
    mask useful = lanes & link.valid & nonzero3(f) & true_side(v, wi, link.direction);
#if ONDE_CULLING // the camera does not see the surface itself from behind
    const mask before = (dot3(v.surface.geometric, link.direction) > 0.0f) == v.surface.front;
    useful = useful & (before | is_double_sided(view, SURFACE_EMITTER(v.surface)));
#endif
    if (!mask_bits(useful)) return no_connection();
    const real factor =
        particle_factor(v, negate3(path.direction), wi, link.direction) * link.importance;
    const real3 power = mul3(path.emitted, path.throughput);
    const real2 pixel = sampler_pair(sampler, vertex_dimension(vertex, VERTEX_DIMENSION_PIXEL));
    return connect_film(view.frame, link, vertex_exit(v, link.direction),
                        mul3(power, scale3(f, factor)), pixel, useful);
}

// Ends paths that carry little; the survivors carry more.
INLINE mask light_roulette(LightPath* path, real u, mask lanes) {
    const real survival = roulette_survival(path->throughput);
    path->throughput = scale3(path->throughput, 1.0f / survival);
    return lanes & (u < survival);
}

// One surface of the paths in `lanes`: `hit` is what their rays met. `bounce` counts from 0 at the
// first surface after the light, which is the first vertex.
OUTLINED LightVertex light_vertex(SceneView view, LightPath path, Hits hit, Sampler sampler,
                                  uint bounce, mask lanes) {
    const uint vertex = bounce + 1;
    const mask found = lanes & (hit.primitive != BVH_NONE);
    LightVertex result;
    result.connection = no_connection();
    result.next = path;
    result.alive = found;
    if (!mask_bits(found)) return result;

    Vertex v;
    v.surface = surface_at(view, path.origin, path.direction, hit, found);
    v.surface.bulge = (real)(0.0f); // light arrives at triangles, and has to leave from there
    v.t = choose(found, hit.t, (real)(0.0f));
#if ONDE_ABSORPTION
    path.throughput = mul3(path.throughput, solid_transmittance(view, v.surface, v.t));
#endif
    v.basis = surface_basis(v.surface);
#if ONDE_DISPERSION
    v.wave = path_wave(view, sampler, v.surface.material, found);
    v.surface.bend = v.wave.bend;
#endif
    v.wo = to_local(v.basis, negate3(path.direction));
    v.wo.z = max_real(v.wo.z, (real)(1e-4f));
    v.bsdf = material_bsdf(view, v.surface, v.basis, v.wo);
    result.connection = connect_surface(view, path, v, sampler, vertex, found);
    if (vertex + 1 >= view.frame->max_depth) {
        result.alive = found & !found;
        return result;
    }

    const real2 choice = sampler_pair(sampler, vertex_dimension(vertex, VERTEX_DIMENSION_CHOICE));
    const real2 u = sampler_pair(sampler, vertex_dimension(vertex, VERTEX_DIMENSION_DIRECTION));
    const BsdfSample s = bsdf_sample(v.bsdf, v.wo, choice.x, u);
    const real3 direction = normalize3(to_world(v.basis, s.wi));
    const real factor = particle_factor(v, negate3(path.direction), s.wi, direction);
    result.next.origin = vertex_exit(v, direction);
    result.next.direction = direction;
    result.next.throughput = mul3(path.throughput, scale3(s.weight, factor));
#if ONDE_DISPERSION
    result.next.throughput = mul3(result.next.throughput, wave_share(v, s.wi, path.dispersed));
    result.next.dispersed = dispersed_along(v, s.wi, path.dispersed);
#endif
    result.alive =
        found & s.valid & true_side(v, s.wi, direction) & nonzero3(result.next.throughput);
    if (bounce >= view.frame->roulette_start) {
        result.alive = light_roulette(&result.next, choice.y, result.alive);
    }
    return result;
}

#endif
