// Rays that lie in memory, a column of slots for each word, against the scene. Ray streams take 16
// or 32 of them at a time, however many lanes shade them.
#ifndef ONDE_TRACE_TRACE_COLUMNS_H
#define ONDE_TRACE_TRACE_COLUMNS_H

#include "trace/trace.h"

// Rays are columns of origin (3) and direction (3); hits are HIT_COLUMNS.
#define RAY_DIRECTION 3
#define RAY_DISTANCE 6 // of rays that end somewhere

// Their moments, where there are moments: a column of slots.
#if ONDE_SHUTTER
    #define TIMES_PARAMETER , Columns times
    #define TIMES(column) , column
#else
    #define TIMES_PARAMETER
    #define TIMES(column)
#endif

#if ONDE_STREAMS

// Puts the ray of slot i into place r.
INLINE void load_ray(StreamRays* rays, uint r, Columns from, uint i TIMES_PARAMETER) {
    for (uint axis = 0; axis < 3; axis++) {
        rays->origin[axis][r] = *column(from, axis, i);
        rays->direction[axis][r] = *column(from, RAY_DIRECTION + axis, i);
    }
    #if ONDE_SHUTTER
    rays->time[r] = *column(times, 0, i);
    #endif
}

INLINE void load_rays(StreamRays* rays, Columns from, uint i, uint count TIMES_PARAMETER) {
    if (count < STREAM_WIDTH) { // what lies behind may be another work item's
        for (uint r = 0; r < count; r++) load_ray(rays, r, from, i + r TIMES(times));
        return;
    }
    #if ONDE_SHUTTER
    vstore16(vload16(0, column(times, 0, i)), 0, rays->time);
    #endif
    for (uint axis = 0; axis < 3; axis++) {
        const real16 origin = vload16(0, column(from, axis, i));
        const real16 direction = vload16(0, column(from, RAY_DIRECTION + axis, i));
        vstore16(origin, 0, rays->origin[axis]);
        vstore16(direction, 0, rays->direction[axis]);
    }
}

INLINE void store_column(Columns to, uint k, uint i, real16 words, uint count) {
    if (count == STREAM_WIDTH) {
        vstore16(words, 0, column(to, k, i));
        return;
    }
    float word[STREAM_WIDTH];
    vstore16(words, 0, word);
    for (uint r = 0; r < count; r++) *column(to, k, i + r) = word[r];
}

// The closest hits of a bounce, the camera's rays being bounce 0, of the slots from begin to end.
INLINE void trace_columns(BvhView bvh, Columns rays, Columns hits, uint bounce, uint begin,
                          uint end TIMES_PARAMETER) {
    StreamRays group;
    StreamHits found;
    for (uint i = begin; i < end; i += STREAM_WIDTH) {
        const uint count = min(end - i, (uint)STREAM_WIDTH);
        load_rays(&group, rays, i, count TIMES(times));
        closest_of_bounce(bvh, &group, &found, bounce, (1u << count) - 1);
        store_column(hits, 0, i, vload16(0, found.t), count);
        store_column(hits, 1, i, vload16(0, found.u), count);
        store_column(hits, 2, i, vload16(0, found.v), count);
        store_column(hits, 3, i, as_real16(vload16(0, found.primitive)), count);
        store_column(hits, 4, i, as_real16(vload16(0, found.instance)), count);
    }
}

    #define OCCLUDED_SLOTS OCCLUDED_WIDTH

// One bit per slot of a list of up to OCCLUDED_SLOTS whose ray is blocked before its distance.
INLINE uint occluded_slots(BvhView bvh, Columns rays, const uint* slots,
                           uint count TIMES_PARAMETER) {
    const float t_min[OCCLUDED_WIDTH] = {0.0f};
    float distance[OCCLUDED_WIDTH];
    StreamRays group;
    for (uint r = 0; r < count; r++) {
        load_ray(&group, r, rays, slots[r] TIMES(times));
        distance[r] = *column(rays, RAY_DISTANCE, slots[r]);
    }
    const uint bits = 0xffffffffu >> (OCCLUDED_WIDTH - count);
    return bvh_occluded_stream(BVH_TO_SCALARS(bvh), &group, t_min, distance, bits);
}

#else

INLINE void trace_columns(BvhView bvh, Columns rays, Columns hits, uint bounce, uint begin,
                          uint end TIMES_PARAMETER) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
    #if ONDE_SHUTTER
        bvh.time = load_real(column(times, 0, i));
    #endif
        store_hits(hits, i,
                   trace_bounce(bvh, load3(rays, 0, i), load3(rays, RAY_DIRECTION, i), bounce,
                                mask_bits(lane_index() + i < end)));
    }
}

    #define OCCLUDED_SLOTS 1

INLINE float3 ray_word3(Columns rays, uint k, uint i) {
    return (float3)(*column(rays, k, i), *column(rays, k + 1, i), *column(rays, k + 2, i));
}
INLINE uint occluded_slots(BvhView bvh, Columns rays, const uint* slots,
                           uint count TIMES_PARAMETER) {
    return bvh_occluded(bvh, ray_word3(rays, 0, slots[0]), 0.0f,
                        ray_word3(rays, RAY_DIRECTION, slots[0]),
                        *column(rays, RAY_DISTANCE, slots[0]) TIME(*column(times, 0, slots[0])));
}

#endif

#endif
