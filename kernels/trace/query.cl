// Rays through the BVH and nothing else: what measures layouts, the traversal bench times and the
// traversal tests ask. A ray is 8 floats: origin, t_min, direction, t_max; a hit is 5 words: t, u,
// v, ids.
#include "trace/bvh.h"

// Whether ray streams and interleaved rays are asked for, which the wide layout alone has.
#ifndef ONDE_STREAM_QUERIES
    #define ONDE_STREAM_QUERIES 0
#endif

INLINE void store_hit(__global float* hits, uint i, Hit hit) {
    hits[5 * i] = hit.t;
    hits[5 * i + 1] = hit.u;
    hits[5 * i + 2] = hit.v;
    hits[5 * i + 3] = as_float(hit.primitive);
    hits[5 * i + 4] = as_float(hit.instance);
}

__kernel void closest(uint count, BVH_SCALARS, __global const float8* rays, __global float* hits) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const BvhView bvh = BVH_FROM_SCALARS;
    const float8 ray = rays[i];
    store_hit(hits, i, bvh_closest(bvh, ray.s012, ray.s3, ray.s456, ray.s7));
}

__kernel void occluded(uint count, BVH_SCALARS, __global const float8* rays,
                       __global uint* blocked) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const BvhView bvh = BVH_FROM_SCALARS;
    const float8 ray = rays[i];
    blocked[i] = bvh_occluded(bvh, ray.s012, ray.s3, ray.s456, ray.s7);
}

#if ONDE_STREAM_QUERIES
// `width` rays from `first` on; after the last one, it again.
INLINE void load_stream(__global const float* rays, uint first, uint count, uint width,
                        StreamRays* stream, float* t_min, float* t_max) {
    for (uint lane = 0; lane < width; lane++) {
        __global const float* ray = rays + 8 * min(first + lane, count - 1);
        for (uint axis = 0; axis < 3; axis++) {
            stream->origin[axis][lane] = ray[axis];
            stream->direction[axis][lane] = ray[4 + axis];
        }
        t_min[lane] = ray[3];
        t_max[lane] = ray[7];
    }
}

// Work item i takes rays 32 i to 32 i + 31, where the set has as many.
__kernel void occluded_stream(uint count, BVH_SCALARS, __global const float* rays,
                              __global uint* blocked) {
    const uint first = OCCLUDED_WIDTH * get_global_id(0);
    if (first >= count) return;
    const BvhView bvh = BVH_FROM_SCALARS;
    StreamRays stream;
    float t_min[OCCLUDED_WIDTH], t_max[OCCLUDED_WIDTH];
    load_stream(rays, first, count, OCCLUDED_WIDTH, &stream, t_min, t_max);
    const uint live = min(count - first, (uint)OCCLUDED_WIDTH);
    const uint hit = bvh_occluded_stream(BVH_TO_SCALARS(bvh), &stream, t_min, t_max,
                                         0xffffffffu >> (OCCLUDED_WIDTH - live));
    for (uint lane = 0; lane < live; lane++) blocked[first + lane] = hit >> lane & 1;
}

    // The kernels below: work item i takes rays 16 i to 16 i + 15, where the set has as many, by
    // one of the traversals.
    #define CLOSEST_OF_SIXTEEN(name, traverse)                                                     \
        __kernel void name(uint count, BVH_SCALARS, __global const float* rays,                    \
                           __global float* hits) {                                                 \
            const uint first = STREAM_WIDTH * get_global_id(0);                                    \
            if (first >= count) return;                                                            \
            const BvhView bvh = BVH_FROM_SCALARS;                                                  \
            StreamRays stream;                                                                     \
            StreamHits found;                                                                      \
            float t_min[STREAM_WIDTH], t_max[STREAM_WIDTH];                                        \
            load_stream(rays, first, count, STREAM_WIDTH, &stream, t_min, t_max);                  \
            clear_stream_hits(&found, vload16(0, t_max));                                          \
            const uint live = min(count - first, (uint)STREAM_WIDTH);                              \
            traverse(BVH_TO_SCALARS(bvh), &stream, t_min, &found, (1u << live) - 1);               \
            for (uint lane = 0; lane < live; lane++)                                               \
                store_hit(hits, first + lane, stream_hit(&found, lane));                           \
        }

CLOSEST_OF_SIXTEEN(closest_stream, bvh_closest_stream)
CLOSEST_OF_SIXTEEN(closest_interleaved, bvh_closest_interleaved)
#endif
