// Rays of several lanes against the scene: one traversal per live lane, or a ray stream of all
// lanes. For rays that lie in memory see trace_columns.h.
#ifndef ONDE_TRACE_TRACE_H
#define ONDE_TRACE_TRACE_H

#include "math/vector.h"
#include "trace/bvh.h"
#include "trace/hits.h"

// Whether rays of several lanes go through the tree as a stream, and the bounces from the camera
// that do; shadow rays then always do.
#ifndef ONDE_STREAMS
    #define ONDE_STREAMS (ONDE_CPU && ONDE_WIDTH > 1 && ONDE_BVH_LAYOUT == BVH_LAYOUT_WIDE)
#endif
#ifndef ONDE_STREAM_BOUNCES
    #define ONDE_STREAM_BOUNCES 2
#endif

// Whether rays of later bounces, which have little in common, are interleaved instead of traced one
// after the other: for trees that the caches do not hold.
#ifndef ONDE_INTERLEAVE
    #define ONDE_INTERLEAVE 0
#endif

#define RAY_INFINITY 1e30f

// Rays, lane by lane, as the scalar traversal wants them.
typedef struct {
    float origin_x[ONDE_WIDTH], origin_y[ONDE_WIDTH], origin_z[ONDE_WIDTH];
    float direction_x[ONDE_WIDTH], direction_y[ONDE_WIDTH], direction_z[ONDE_WIDTH];
#if ONDE_SHUTTER
    float time[ONDE_WIDTH];
#endif
} SpilledRays;

INLINE void spill_rays(SpilledRays* rays, BvhView bvh, real3 origin, real3 direction) {
    spill_real(rays->origin_x, origin.x);
    spill_real(rays->origin_y, origin.y);
    spill_real(rays->origin_z, origin.z);
    spill_real(rays->direction_x, direction.x);
    spill_real(rays->direction_y, direction.y);
    spill_real(rays->direction_z, direction.z);
#if ONDE_SHUTTER
    spill_real(rays->time, bvh.time);
#endif
}
INLINE float3 spilled_origin(const SpilledRays* rays, uint k) {
    return (float3)(rays->origin_x[k], rays->origin_y[k], rays->origin_z[k]);
}
INLINE float3 spilled_direction(const SpilledRays* rays, uint k) {
    return (float3)(rays->direction_x[k], rays->direction_y[k], rays->direction_z[k]);
}

// And what it finds.
typedef struct {
    float t[ONDE_WIDTH], u[ONDE_WIDTH], v[ONDE_WIDTH];
    float primitive[ONDE_WIDTH], instance[ONDE_WIDTH]; // their bits
} SpilledHits;

INLINE void spill_hits(SpilledHits* spilled, Hits hits) {
    spill_real(spilled->t, hits.t);
    spill_real(spilled->u, hits.u);
    spill_real(spilled->v, hits.v);
    spill_real(spilled->primitive, as_real(hits.primitive));
    spill_real(spilled->instance, as_real(hits.instance));
}
INLINE void set_spilled_hit(SpilledHits* spilled, uint k, Hit hit) {
    spilled->t[k] = hit.t;
    spilled->u[k] = hit.u;
    spilled->v[k] = hit.v;
    spilled->primitive[k] = as_float(hit.primitive);
    spilled->instance[k] = as_float(hit.instance);
}
INLINE Hits unspill_hits(const SpilledHits* spilled) {
    Hits hits;
    hits.t = unspill_real(spilled->t);
    hits.u = unspill_real(spilled->u);
    hits.v = unspill_real(spilled->v);
    hits.primitive = as_natural(unspill_real(spilled->primitive));
    hits.instance = as_natural(unspill_real(spilled->instance));
    return hits;
}

// Closest hits of the lanes in `bits`; the other lanes miss.
INLINE Hits trace_closest(BvhView bvh, real3 origin, real3 direction, uint bits) {
    SpilledRays rays;
    spill_rays(&rays, bvh, origin, direction);
    SpilledHits hits;
    Hits nothing;
    nothing.t = (real)(RAY_INFINITY);
    nothing.u = nothing.v = (real)(0.0f);
    nothing.primitive = nothing.instance = (natural)(BVH_NONE);
    spill_hits(&hits, nothing);
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        const Hit hit = bvh_closest(bvh, spilled_origin(&rays, k), 0.0f,
                                    spilled_direction(&rays, k), RAY_INFINITY TIME(rays.time[k]));
        set_spilled_hit(&hits, k, hit);
    }
    return unspill_hits(&hits);
}

#if ONDE_PASSING
// The closest hits of the lanes in `bits` behind those that are given, up to t_max; the other lanes
// keep theirs. (A hit of zeros is before all others.)
INLINE Hits trace_behind(BvhView bvh, real3 origin, real3 direction, real t_max, Hits hits,
                         uint bits) {
    SpilledRays rays;
    spill_rays(&rays, bvh, origin, direction);
    SpilledHits behind;
    float end[ONDE_WIDTH];
    spill_hits(&behind, hits);
    spill_real(end, t_max);
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        const PassedHit passed = {behind.t[k], as_uint(behind.primitive[k]),
                                  as_uint(behind.instance[k])};
        const Hit hit =
            bvh_closest_behind(bvh, spilled_origin(&rays, k), spilled_direction(&rays, k), end[k],
                               passed TIME(rays.time[k]));
        set_spilled_hit(&behind, k, hit);
    }
    return unspill_hits(&behind);
}
#endif

#if ONDE_STREAMS
// Up to 16 rays of a bounce: those that see what the camera sees, or just left it, as a stream, the
// rest interleaved or one after the other.
INLINE void closest_of_bounce(BvhView bvh, StreamRays* rays, StreamHits* hits, uint bounce,
                              uint bits) {
    const float t_min[STREAM_WIDTH] = {0.0f};
    clear_stream_hits(hits, RAY_INFINITY);
    if (bounce < ONDE_STREAM_BOUNCES) {
        bvh_closest_stream(BVH_TO_SCALARS(bvh), rays, t_min, hits, bits);
        return;
    }
    #if ONDE_INTERLEAVE
    bvh_closest_interleaved(BVH_TO_SCALARS(bvh), rays, t_min, hits, bits);
    #else
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        set_stream_hit(hits, r,
                       bvh_closest(bvh, stream_origin(rays, r), 0.0f, stream_direction(rays, r),
                                   RAY_INFINITY TIME(rays->time[r])));
    }
    #endif
}

INLINE void load_stream(StreamRays* rays, BvhView bvh, real3 origin, real3 direction) {
    if (ONDE_WIDTH < STREAM_WIDTH) clear_first_half(rays);
    spill_real(rays->origin[0], origin.x);
    spill_real(rays->origin[1], origin.y);
    spill_real(rays->origin[2], origin.z);
    spill_real(rays->direction[0], direction.x);
    spill_real(rays->direction[1], direction.y);
    spill_real(rays->direction[2], direction.z);
    #if ONDE_SHUTTER
    spill_real(rays->time, bvh.time);
    #endif
}
#endif

// The closest hits of a bounce, the camera's rays being bounce 0.
#if ONDE_STREAMS
INLINE Hits trace_bounce(BvhView bvh, real3 origin, real3 direction, uint bounce, uint bits) {
    StreamRays rays;
    StreamHits found;
    load_stream(&rays, bvh, origin, direction);
    closest_of_bounce(bvh, &rays, &found, bounce, bits);
    Hits hits;
    hits.t = unspill_real(found.t);
    hits.u = unspill_real(found.u);
    hits.v = unspill_real(found.v);
    hits.primitive = unspill_natural(found.primitive);
    hits.instance = unspill_natural(found.instance);
    return hits;
}
#else
INLINE Hits trace_bounce(BvhView bvh, real3 origin, real3 direction, uint bounce, uint bits) {
    return trace_closest(bvh, origin, direction, bits);
}
#endif

// Rays that are asked about together: OCCLUDED_GROUPS times as many as there are lanes.
#if ONDE_STREAMS
    #define OCCLUDED_GROUPS (OCCLUDED_WIDTH / ONDE_WIDTH)
typedef StreamRays OccludedRays;
#else
    #define OCCLUDED_GROUPS 1
typedef struct {
    float origin[3][ONDE_WIDTH], direction[3][ONDE_WIDTH];
    #if ONDE_SHUTTER
    float time[ONDE_WIDTH];
    #endif
} OccludedRays;
#endif
typedef struct {
    OccludedRays rays;
    float distance[OCCLUDED_GROUPS * ONDE_WIDTH];
} Occlusion;

INLINE void put_group(Occlusion* o, uint group, real3 origin, real3 direction, real distance) {
    const uint first = group * ONDE_WIDTH;
    spill_real(o->rays.origin[0] + first, origin.x);
    spill_real(o->rays.origin[1] + first, origin.y);
    spill_real(o->rays.origin[2] + first, origin.z);
    spill_real(o->rays.direction[0] + first, direction.x);
    spill_real(o->rays.direction[1] + first, direction.y);
    spill_real(o->rays.direction[2] + first, direction.z);
    spill_real(o->distance + first, distance);
#if ONDE_SHUTTER
    spill_real(o->rays.time + first, (real)(0.0f));
#endif
}

INLINE float3 occluded_origin(const Occlusion* o, uint r) {
    return (float3)(o->rays.origin[0][r], o->rays.origin[1][r], o->rays.origin[2][r]);
}
INLINE float3 occluded_direction(const Occlusion* o, uint r) {
    return (float3)(o->rays.direction[0][r], o->rays.direction[1][r], o->rays.direction[2][r]);
}

// The rays of a group.
INLINE real3 group_origin(const Occlusion* o, uint group) {
    const uint first = group * ONDE_WIDTH;
    return make3(unspill_real(o->rays.origin[0] + first), unspill_real(o->rays.origin[1] + first),
                 unspill_real(o->rays.origin[2] + first));
}
INLINE real3 group_direction(const Occlusion* o, uint group) {
    const uint first = group * ONDE_WIDTH;
    return make3(unspill_real(o->rays.direction[0] + first),
                 unspill_real(o->rays.direction[1] + first),
                 unspill_real(o->rays.direction[2] + first));
}

// One bit per ray of `bits`, among those of the first groups, whose way to its distance is blocked.
INLINE uint occluded_groups(BvhView bvh, Occlusion* o, uint groups, uint bits) {
#if ONDE_STREAMS
    const float t_min[OCCLUDED_WIDTH] = {0.0f};
    const real3 none = splat3((real)(0.0f)); // so that arithmetic on idle places is on numbers
    for (; groups * ONDE_WIDTH % STREAM_WIDTH; groups++)
        put_group(o, groups, none, none, (real)(0.0f));
    return bvh_occluded_stream(BVH_TO_SCALARS(bvh), &o->rays, t_min, o->distance, bits);
#else
    uint blocked = 0;
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        if (bvh_occluded(bvh, occluded_origin(o, r), 0.0f, occluded_direction(o, r),
                         o->distance[r] TIME(o->rays.time[r])))
            blocked |= 1u << r;
    }
    return blocked;
#endif
}

// One bit per lane of `bits` whose way to `distance` is blocked.
INLINE uint trace_occluded(BvhView bvh, real3 origin, real3 direction, real distance, uint bits) {
    Occlusion o;
    put_group(&o, 0, origin, direction, distance);
#if ONDE_SHUTTER
    spill_real(o.rays.time, bvh.time);
#endif
    return occluded_groups(bvh, &o, 1, bits);
}

#endif
