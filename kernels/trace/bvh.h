// The tree, in whichever layout the kernels are compiled for, walked by one ray.
//
// A ray is origin, t_min >= 0, direction (any length), t_max; it hits at t_min < t <= t_max. A ray
// with a NaN or an infinity in origin or direction hits nothing. The answer does not depend on the
// order of the walk, nor on which of the walks (single, packet, stream, portable) was asked.
#ifndef ONDE_TRACE_BVH_H
#define ONDE_TRACE_BVH_H

// Not below the condition: a file is taken in where it is first named, and nowhere else.
#include "trace/bvh_slot.h"
#include "trace/bvh_view.h"

#if ONDE_BVH_LAYOUT == BVH_LAYOUT_WIDE
    #include "trace/bvh_wide.h"
#elif ONDE_BVH_LAYOUT == BVH_LAYOUT_COMPRESSED
    #include "trace/bvh_compressed.h"
#else
    #include "trace/bvh_binary.h"
#endif

// The closest hit of the ray.
INLINE Hit bvh_closest(BvhView bvh, float3 origin, float t_min, float3 direction, float t_max) {
    return traverse_closest(BVH_TO_SCALARS(bvh), origin, t_min, direction, t_max);
}

// Whether anything is hit: 1 or 0.
INLINE uint bvh_occluded(BvhView bvh, float3 origin, float t_min, float3 direction, float t_max) {
    return traverse_occluded(BVH_TO_SCALARS(bvh), origin, t_min, direction, t_max);
}

#endif
