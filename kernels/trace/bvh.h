// One ray through the BVH. The text of the BVH's layout, one of trace/layout_*.h, comes before this
// file in every program; so a program holds no other layout's.
//
// A ray is origin, t_min >= 0, direction (any length), t_max; it hits at t_min < t <= t_max. A ray
// with a NaN or an infinity in origin or direction hits nothing. The answer does not depend on the
// order of the traversal, nor on which traversal (single, packet, stream, interleaved) was asked.
#ifndef ONDE_TRACE_BVH_H
#define ONDE_TRACE_BVH_H

#include "trace/bvh_view.h"

#ifndef ONDE_BVH_LAYOUT
    #error "the text of a layout (trace/layout_wide.h or another) has to come first"
#endif

// The closest hit of the ray.
INLINE Hit bvh_closest(BvhView bvh, float3 origin, float t_min, float3 direction,
                       float t_max TIME_PARAMETER) {
    return traverse_closest(BVH_TO_SCALARS(bvh), origin, t_min, direction,
                            t_max TIME(time) PASSED_NOTHING);
}

#if ONDE_PASSING
// The closest hit of the ray, up to t_max, behind the one that it has passed: nothing is hit twice,
// and of surfaces at the same distance none is left out, as their ids order them.
INLINE Hit bvh_closest_behind(BvhView bvh, float3 origin, float3 direction, float t_max,
                              PassedHit passed TIME_PARAMETER) {
    return traverse_closest(BVH_TO_SCALARS(bvh), origin, 0.0f, direction, t_max TIME(time),
                            passed.t, passed.primitive, passed.instance);
}
#endif

// Whether anything is hit: 1 or 0.
INLINE uint bvh_occluded(BvhView bvh, float3 origin, float t_min, float3 direction,
                         float t_max TIME_PARAMETER) {
    return traverse_occluded(BVH_TO_SCALARS(bvh), origin, t_min, direction, t_max TIME(time));
}

#endif
