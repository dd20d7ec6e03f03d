// The tree, in whichever layout the kernels are compiled for, walked by one ray.
//
// A ray is origin, t_min >= 0, direction (any length), t_max; it hits at t_min < t <= t_max. A ray
// with a NaN or an infinity in origin or direction hits nothing. The answer does not depend on the
// order of the walk, nor on which of the walks (single, packet, stream, portable) was asked.
#ifndef ONDE_LIB_BVH_H
#define ONDE_LIB_BVH_H

// Not below the condition: a file is taken in where it is first named, and nowhere else.
#include "lib/bvh_slot.h"
#include "lib/bvh_view.h"

#if ONDE_BVH_LAYOUT == BVH_LAYOUT_WIDE
    #include "lib/bvh_wide.h"
#elif ONDE_BVH_LAYOUT == BVH_LAYOUT_COMPRESSED
    #include "lib/bvh_compressed.h"
#else
    #include "lib/bvh_binary.h"
#endif

// The closest hit of the ray.
INLINE Hit bvh_closest(BvhView bvh, float3 origin, float t_min, float3 direction, float t_max) {
    return walk_closest(BVH_TO_SCALARS(bvh), origin, t_min, direction, t_max);
}

// Whether anything is hit: 1 or 0.
INLINE uint bvh_occluded(BvhView bvh, float3 origin, float t_min, float3 direction, float t_max) {
    return walk_occluded(BVH_TO_SCALARS(bvh), origin, t_min, direction, t_max);
}

#endif
