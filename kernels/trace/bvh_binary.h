// The binary tree, traversed by one ray: both boxes of a pair at once, the nearer child first.
#ifndef ONDE_TRACE_BVH_BINARY_H
#define ONDE_TRACE_BVH_BINARY_H

#include "trace/bvh_slot.h"

INLINE __global const BvhPair* bvh_pair(BvhView bvh, uint word) {
    return (__global const BvhPair*)bvh.nodes + word;
}
INLINE uint leaf_first(uint word) {
    return word & ((1u << BINARY_COUNT_SHIFT) - 1);
}
INLINE uint leaf_count(uint word) {
    return ((word & ~BVH_LEAF) >> BINARY_COUNT_SHIFT) + 1;
}

// Where a ray enters the two boxes of a pair, and where it leaves them.
typedef struct {
    float2 near, far;
} PairSpans;

INLINE float2 pair_distance(__global const float2* planes, uint plane, float inverse, float start) {
    return fma(planes[plane], (float2)(inverse), (float2)(start));
}
INLINE PairSpans span_pair(__global const BvhPair* pair, SlabRay ray, float t_min, float t_max) {
    __global const float2* planes = (__global const float2*)pair;
    const uint3 first = ray.plane / 64; // rows of this layout are as many as of the wide one
    const float2 near_x = pair_distance(planes, first.x, ray.inverse.x, ray.near.x);
    const float2 near_y = pair_distance(planes, first.y, ray.inverse.y, ray.near.y);
    const float2 near_z = pair_distance(planes, first.z, ray.inverse.z, ray.near.z);
    const float2 far_x = pair_distance(planes, first.x ^ 1, ray.inverse.x, ray.far.x);
    const float2 far_y = pair_distance(planes, first.y ^ 1, ray.inverse.y, ray.far.y);
    const float2 far_z = pair_distance(planes, first.z ^ 1, ray.inverse.z, ray.far.z);
    const float2 near_xy = max_fast(near_x, near_y), near_zt = max_fast(near_z, (float2)(t_min));
    const float2 far_xy = min_fast(far_x, far_y), far_zt = min_fast(far_z, (float2)(t_max));
    const PairSpans spans = {max_fast(near_xy, near_zt), min_fast(far_xy, far_zt)};
    return spans;
}

OUTLINED Hit traverse_closest(BVH_SCALARS, float3 origin, float t_min, float3 direction,
                              float t_max TIME_PARAMETER PASSED_PARAMETERS) {
    const BvhView bvh = BVH_FROM_SCALARS;
    Hit hit = {t_max, 0.0f, 0.0f, BVH_NONE, BVH_NONE};
    PASS_IN(hit);
    if (!is_finite_ray(origin, direction)) return hit;
    ulong stack[ONDE_STACK_SIZE];
    DECLARE_COUNTERS
    uint size = 0;
    const PlacedRay start = place_ray(origin, direction, ENTRY_BEHIND(t_min), BVH_NONE TIME(time));
    PlacedRay ray = start;
    ulong at = stack_entry(t_min, bvh.root);
    for (;;) {
        const uint word = (uint)at;
        if (!(word & BVH_LEAF)) {
            __global const BvhPair* pair = bvh_pair(bvh, word);
            COUNT_TESTS(boxes, 1 + (pair->child[1] != BVH_NONE));
            const PairSpans spans = span_pair(pair, ray.slab, ray.entry, hit.t);
            const uint meets_0 = spans.near.x <= spans.far.x, meets_1 = spans.near.y <= spans.far.y;
            const ulong first = stack_entry(spans.near.x, pair->child[0]);
            const ulong second = stack_entry(spans.near.y, pair->child[1]);
            if (meets_0 && meets_1) {
                at = min_fast(first, second);
                stack[size++] = max_fast(first, second);
                continue;
            }
            if (meets_0 || meets_1) {
                at = meets_0 ? first : second;
                continue;
            }
        } else if (word != BVH_NONE) {
            const uint end = leaf_first(word) + leaf_count(word);
            for (uint i = leaf_first(word); i < end; i++) {
                __global const BvhSlot* slot = bvh_slot(bvh, i);
#if ONDE_INSTANCES
                if (slot->kind == BVH_LEAF_INSTANCE) { // alone in its leaf
                    const float near = entry_distance(at);
                    ray =
                        place_in_instance(bvh, slot->primitive, origin, direction, near TIME(time));
                    stack[size++] = STACK_LEAVE_INSTANCE;
                    stack[size++] = stack_entry(near, bvh.instances[slot->primitive].root);
                    break;
                }
#endif
                COUNT_TESTS(primitives, 1);
                hit = closest_in_slot(bvh, slot, ray, t_min, entry_distance(at), hit);
            }
        } else {
            ray = start;
        }
        do {
            if (size == 0) {
                STORE_COUNTERS(hit)
                return hit;
            }
            at = stack[--size];
        } while (entry_distance(at) > hit.t);
    }
}

OUTLINED uint traverse_occluded(BVH_SCALARS, float3 origin, float t_min, float3 direction,
                                float t_max TIME_PARAMETER) {
    const BvhView bvh = BVH_FROM_SCALARS;
    if (!is_finite_ray(origin, direction)) return 0;
    uint stack[ONDE_STACK_SIZE];
    uint size = 0;
    const PlacedRay start = place_ray(origin, direction, t_min, BVH_NONE TIME(time));
    PlacedRay ray = start;
    uint word = bvh.root;
    for (;;) {
        if (!(word & BVH_LEAF)) {
            __global const BvhPair* pair = bvh_pair(bvh, word);
            const PairSpans spans = span_pair(pair, ray.slab, t_min, t_max);
            const uint meets_0 = spans.near.x <= spans.far.x, meets_1 = spans.near.y <= spans.far.y;
            if (meets_0 || meets_1) {
                word = meets_0 ? pair->child[0] : pair->child[1];
                if (meets_0 && meets_1) stack[size++] = pair->child[1];
                continue;
            }
        } else if (word != BVH_NONE) {
            const uint end = leaf_first(word) + leaf_count(word);
            for (uint i = leaf_first(word); i < end; i++) {
                __global const BvhSlot* slot = bvh_slot(bvh, i);
#if ONDE_INSTANCES
                if (slot->kind == BVH_LEAF_INSTANCE) {
                    ray = place_in_instance(bvh, slot->primitive, origin, direction,
                                            t_min TIME(time));
                    stack[size++] = BVH_NONE;
                    stack[size++] = bvh.instances[slot->primitive].root;
                    break;
                }
#endif
                if (any_in_slot(bvh, slot, ray, t_min, t_max)) return 1;
            }
        } else {
            ray = start;
        }
        if (size == 0) return 0;
        word = stack[--size];
    }
}

#endif
