// Rays that lie in memory, a row of slots for each number, against the scene. Where rays walk in
// company they do so 16 at a time, however many lanes shade them.
#ifndef ONDE_TRACE_TRACE_ROWS_H
#define ONDE_TRACE_TRACE_ROWS_H

#include "trace/trace.h"

// Rows of x, y, z of origins and of directions. Number k of slot i is at k * stride + i.
typedef struct {
    __global const float *origin, *direction;
    uint stride;
} RayRows;

// Rows of t, u, v, primitive, instance.
typedef struct {
    __global float* rows;
    uint stride;
} HitRows;

INLINE __global const float* ray_row(__global const float* rows, uint stride, uint k, uint i) {
    return rows + (size_t)k * stride + i;
}
INLINE __global float* hit_row(HitRows hits, uint k, uint i) {
    return hits.rows + (size_t)k * hits.stride + i;
}

INLINE real3 load_rows3(__global const float* rows, uint stride, uint i) {
    return make3(load_real(ray_row(rows, stride, 0, i)), load_real(ray_row(rows, stride, 1, i)),
                 load_real(ray_row(rows, stride, 2, i)));
}

INLINE Hits load_hit_rows(HitRows rows, uint i) {
    Hits hits;
    hits.t = load_real(hit_row(rows, 0, i));
    hits.u = load_real(hit_row(rows, 1, i));
    hits.v = load_real(hit_row(rows, 2, i));
    hits.primitive = load_natural(hit_row(rows, 3, i));
    hits.instance = load_natural(hit_row(rows, 4, i));
    return hits;
}

#if ONDE_STREAMS

// Puts the ray of slot i into place r.
INLINE void load_ray(StreamRays* rays, uint r, RayRows from, uint i) {
    for (uint axis = 0; axis < 3; axis++) {
        rays->origin[axis][r] = *ray_row(from.origin, from.stride, axis, i);
        rays->direction[axis][r] = *ray_row(from.direction, from.stride, axis, i);
    }
}

INLINE void load_rays(StreamRays* rays, RayRows from, uint i, uint count) {
    if (count < STREAM_WIDTH) { // what lies behind may be another work item's
        clear_first_half(rays);
        for (uint r = 0; r < count; r++) load_ray(rays, r, from, i + r);
        return;
    }
    for (uint axis = 0; axis < 3; axis++) {
        const float16 origin = vload16(0, ray_row(from.origin, from.stride, axis, i));
        const float16 direction = vload16(0, ray_row(from.direction, from.stride, axis, i));
        vstore16(origin, 0, rays->origin[axis]);
        vstore16(direction, 0, rays->direction[axis]);
    }
}

INLINE void store_row(HitRows to, uint k, uint i, float16 words, uint count) {
    if (count == STREAM_WIDTH) {
        vstore16(words, 0, hit_row(to, k, i));
        return;
    }
    float word[STREAM_WIDTH];
    vstore16(words, 0, word);
    for (uint r = 0; r < count; r++) *hit_row(to, k, i + r) = word[r];
}

// The closest hits of a bounce, the camera's rays being bounce 0, of the slots from begin to end.
INLINE void trace_rows(BvhView bvh, RayRows rays, HitRows hits, uint bounce, uint begin, uint end) {
    StreamRays group;
    StreamHits found;
    for (uint i = begin; i < end; i += STREAM_WIDTH) {
        const uint count = min(end - i, (uint)STREAM_WIDTH);
        load_rays(&group, rays, i, count);
        closest_in_company(bvh, &group, &found, bounce, (1u << count) - 1);
        store_row(hits, 0, i, vload16(0, found.t), count);
        store_row(hits, 1, i, vload16(0, found.u), count);
        store_row(hits, 2, i, vload16(0, found.v), count);
        store_row(hits, 3, i, as_float16(vload16(0, found.primitive)), count);
        store_row(hits, 4, i, as_float16(vload16(0, found.instance)), count);
    }
}

#else

INLINE void trace_rows(BvhView bvh, RayRows rays, HitRows hits, uint bounce, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const Hits found = trace_bounce(bvh, load_rows3(rays.origin, rays.stride, i),
                                        load_rows3(rays.direction, rays.stride, i), bounce,
                                        mask_bits(lane_index() + i < end));
        store_real(hit_row(hits, 0, i), found.t);
        store_real(hit_row(hits, 1, i), found.u);
        store_real(hit_row(hits, 2, i), found.v);
        store_natural(hit_row(hits, 3, i), found.primitive);
        store_natural(hit_row(hits, 4, i), found.instance);
    }
}

#endif

#endif
