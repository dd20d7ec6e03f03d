// The wide tree, traversed by one ray: closest hit and any hit. Scalar per ray whatever ONDE_WIDTH
// is; the lanes in here are the 16 children of a node and the 8 triangles of a leaf.
#ifndef ONDE_TRACE_BVH_WIDE_H
#define ONDE_TRACE_BVH_WIDE_H

#include "trace/bvh_view.h"

INLINE __global const uchar* bvh_node(BvhView bvh, uint word) {
    return bvh.nodes + (size_t)word * sizeof(BvhNode);
}
INLINE __global const uchar* bvh_block(BvhView bvh, uint word) {
    return bvh.blocks + (size_t)(word & BVH_INDEX_MASK) * sizeof(TriangleBlock);
}
INLINE __global const uint* bvh_children(__global const uchar* node) {
    return (__global const uint*)(node + 384);
}

// Those of a node, and those of a leaf block.
INLINE uint count_children(__global const uint* children) {
    return popcount(bits16(*(__global const natural16*)children != (natural16)(BVH_NONE)));
}
INLINE uint count_triangles(__global const uchar* block) {
    return popcount(bits8(((__global const uint8*)block)[9] != (uint8)(BVH_NONE)));
}

INLINE void bvh_prefetch(BvhView bvh, uint word) {
    if (word & BVH_LEAF)
        prefetch_block(bvh_block(bvh, word));
    else
        prefetch_node(bvh_node(bvh, word));
}

#define SORT_DESCENDING(a, b)                                                                      \
    {                                                                                              \
        const ulong high = a > b ? a : b, low = a > b ? b : a;                                     \
        a = high;                                                                                  \
        b = low;                                                                                   \
    }

// Takes the next child of `bits` as a stack entry.
#define NEXT_ENTRY(entry)                                                                          \
    const uint slot_##entry = lowest_bit(bits);                                                    \
    ulong entry = stack_entry(near[slot_##entry], children[slot_##entry]);                         \
    bits &= bits - 1;

#define PREFETCH_NONE 0
#define PREFETCH_WAITING 1

// Pushes the children in `bits`, of which there are at least two, but for the nearest, which it
// returns; nearer ones lie higher on the stack. All but the first are prefetched, or none.
INLINE ulong push_farther(ulong* stack, uint* size, BvhView bvh, __global const uint* children,
                          const float* near, uint bits, uint prefetches) {
    NEXT_ENTRY(a)
    NEXT_ENTRY(b)
    if (prefetches) bvh_prefetch(bvh, (uint)b);
    ulong* top = stack + *size;
    if (!bits) {
        SORT_DESCENDING(a, b)
        top[0] = a;
        *size += 1;
        return b;
    }
    NEXT_ENTRY(c)
    if (prefetches) bvh_prefetch(bvh, (uint)c);
    if (!bits) {
        SORT_DESCENDING(a, b)
        SORT_DESCENDING(b, c)
        SORT_DESCENDING(a, b)
        top[0] = a;
        top[1] = b;
        *size += 2;
        return c;
    }
    NEXT_ENTRY(d)
    if (prefetches) bvh_prefetch(bvh, (uint)d);
    SORT_DESCENDING(a, b)
    SORT_DESCENDING(c, d)
    SORT_DESCENDING(a, c)
    SORT_DESCENDING(b, d)
    SORT_DESCENDING(b, c)
    top[0] = a;
    top[1] = b;
    top[2] = c;
    *size += 3;
    while (bits) { // insertion from the top; d stays the nearest
        NEXT_ENTRY(e)
        if (prefetches) bvh_prefetch(bvh, (uint)e);
        SORT_DESCENDING(e, d)
        uint i = (*size)++;
        for (; stack + i > top && stack[i - 1] < e; i--) stack[i] = stack[i - 1];
        stack[i] = e;
    }
    return d;
}

// `hit`, or the closest hit below the child `word`, whose box `ray` enters at `distance`. The stack
// is what is free of it. `start` is the ray in the space in which the traversal begins.
INLINE Hit closest_below(BvhView bvh, uint word, float distance, PlacedRay start, float t_min,
                         ulong* stack, Hit hit) {
    float near[BVH_WIDTH] __attribute__((aligned(64)));
    uint size = 0;
    PlacedRay ray = start;
    DECLARE_COUNTERS
    for (;;) {
        if (!(word & BVH_LEAF)) {
            __global const uchar* node = bvh_node(bvh, word);
            __global const uint* children = bvh_children(node);
            COUNT_TESTS(boxes, count_children(children));
            const NodeHits hits = meet_node(node, ray.slab, ray.entry, hit.t);
            if (hits.bits) {
                *(real16*)near = hits.near;
                const uint first = lowest_bit(hits.bits);
                word = children[first];
                distance = near[first];
                if (hits.bits & (hits.bits - 1)) {
                    const ulong nearest = push_farther(stack, &size, bvh, children, near, hits.bits,
                                                       PREFETCH_WAITING);
                    word = (uint)nearest;
                    distance = entry_distance(nearest);
                }
                continue;
            }
        } else if ((word & BVH_KIND_MASK) == BVH_LEAF_TRIANGLES) {
            COUNT_TESTS(primitives, count_triangles(bvh_block(bvh, word)));
            hit = closest_in_block(bvh_block(bvh, word), ray.origin, t_min, ray.direction, distance,
                                   ray.instance, hit);
        }
#if ONDE_SPHERES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_SPHERE) {
            COUNT_TESTS(primitives, 1);
            hit = closest_on_sphere(bvh.spheres[word & BVH_INDEX_MASK], ray.origin, t_min,
                                    ray.direction, distance, ray.instance, hit);
        }
#endif
#if ONDE_SHAPES
        else if (word != BVH_NONE && (word & BVH_KIND_MASK) == BVH_LEAF_SHAPE) {
            COUNT_TESTS(primitives, 1);
            hit = closest_on_shape(bvh.spheres[word & BVH_INDEX_MASK], ray.origin, t_min,
                                   ray.direction, distance, ray.instance, hit);
        }
#endif
#if ONDE_INSTANCES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_INSTANCE) {
            const uint instance = word & BVH_INDEX_MASK;
            ray = place_in_instance(bvh, instance, start.origin, start.direction,
                                    distance TIME(start.time));
            stack[size++] = STACK_LEAVE_INSTANCE;
            word = bvh.instances[instance].root;
            continue;
        } else {
            ray = start;
        }
#endif
        do {
            if (size == 0) {
                // A copy: the variable that is returned lives in memory, and `hit` must not.
                STORE_COUNTERS(hit)
                const Hit closest = hit;
                return closest;
            }
            size--;
            distance = entry_distance(stack[size]);
        } while (distance > hit.t);
        word = (uint)stack[size];
    }
}

OUTLINED Hit traverse_closest(BVH_SCALARS, float3 origin, float t_min, float3 direction,
                              float t_max TIME_PARAMETER PASSED_PARAMETERS) {
    const BvhView bvh = BVH_FROM_SCALARS;
    Hit miss = {t_max, 0.0f, 0.0f, BVH_NONE, BVH_NONE};
    PASS_IN(miss);
    if (!is_finite_ray(origin, direction)) return miss;
    ulong stack[ONDE_STACK_SIZE];
    const float entry = ENTRY_BEHIND(t_min);
    return closest_below(bvh, bvh.root, entry,
                         place_ray(origin, direction, entry, BVH_NONE TIME(time)), t_min, stack,
                         miss);
}

OUTLINED uint traverse_occluded(BVH_SCALARS, float3 origin, float t_min, float3 direction,
                                float t_max TIME_PARAMETER) {
    const BvhView bvh = BVH_FROM_SCALARS;
    if (!is_finite_ray(origin, direction)) return 0;
    uint stack[ONDE_STACK_SIZE];
    uint size = 0;
    SlabRay slab = make_slab_ray(origin, direction);
    float3 local_origin = origin, local_direction = direction;
    uint word = bvh.root;
    for (;;) {
        if (!(word & BVH_LEAF)) {
            __global const uchar* node = bvh_node(bvh, word);
            __global const uint* children = bvh_children(node);
            uint bits = meet_node(node, slab, t_min, t_max).bits;
            if (bits) {
                // The largest child, which lies in the first slot, is the likeliest to end the
                // traversal.
                word = children[lowest_bit(bits)];
                for (bits &= bits - 1; bits; bits &= bits - 1) {
                    const uint child = children[lowest_bit(bits)];
                    bvh_prefetch(bvh, child);
                    stack[size++] = child;
                }
                continue;
            }
        } else if ((word & BVH_KIND_MASK) == BVH_LEAF_TRIANGLES) {
            if (any_in_block(bvh_block(bvh, word), local_origin, t_min, local_direction, t_max))
                return 1;
        }
#if ONDE_SPHERES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_SPHERE) {
            if (sphere_distance(bvh.spheres[word & BVH_INDEX_MASK], local_origin, t_min,
                                local_direction, t_max) != INFINITY)
                return 1;
        }
#endif
#if ONDE_SHAPES
        else if (word != BVH_NONE && (word & BVH_KIND_MASK) == BVH_LEAF_SHAPE) {
            if (shape_distance(bvh.spheres[word & BVH_INDEX_MASK], local_origin, t_min,
                               local_direction, t_max) != INFINITY)
                return 1;
        }
#endif
#if ONDE_INSTANCES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_INSTANCE) {
            const uint instance = word & BVH_INDEX_MASK;
            const PlacedRay inside =
                place_in_instance(bvh, instance, origin, direction, t_min TIME(time));
            local_origin = inside.origin;
            local_direction = inside.direction;
            slab = inside.slab;
            stack[size++] = BVH_NONE;
            word = bvh.instances[instance].root;
            continue;
        } else {
            local_origin = origin;
            local_direction = direction;
            slab = make_slab_ray(origin, direction);
        }
#endif
        if (size == 0) return 0;
        word = stack[--size];
    }
}

#endif
