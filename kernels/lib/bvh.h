// The tree, walked by one ray: closest hit and any hit. Scalar per ray whatever ONDE_WIDTH is; the
// lanes in here are the 16 children of a node and the 8 triangles of a leaf.
//
// A ray is origin, t_min >= 0, direction (any length), t_max; it hits at t_min < t <= t_max. A ray
// with a NaN or an infinity in origin or direction hits nothing. The answer does not depend on the
// order of the walk, nor on which of the walks (single, packet, portable) was asked.
#ifndef ONDE_LIB_BVH_H
#define ONDE_LIB_BVH_H

#include "lib/bvh_leaf.h"
#include "lib/bvh_slab.h"

// Entries that the tree's deepest walk needs: Bvh::stack_size.
#ifndef ONDE_STACK_SIZE
    #define ONDE_STACK_SIZE 256
#endif
// Whether some leaf of the tree is an instance, or a sphere; the code for it is left out otherwise.
#ifndef ONDE_INSTANCES
    #define ONDE_INSTANCES 1
#endif
#ifndef ONDE_SPHERES
    #define ONDE_SPHERES 1
#endif
// Whether some leaf is an analytic shape; those hang in instances only.
#ifndef ONDE_SHAPES
    #define ONDE_SHAPES ONDE_INSTANCES
#endif

typedef struct {
    __global const uchar* nodes;
    __global const uchar* blocks;
    __global const BvhSphere* spheres;
    __global const BvhInstance* instances;
    uint root; // child word
} BvhView;

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
    return popcount(bits16(*(__global const uint16*)children != (uint16)(BVH_NONE)));
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

INLINE uint is_finite_ray(float3 origin, float3 direction) {
    const float3 sum = (origin + direction) * 0.0f; // NaN where there was NaN or infinity
    return sum.x + sum.y + sum.z == 0.0f;
}

// What waits on the stack of a closest-hit walk: distance << 32 | child word. Positive floats order
// like their bits, so one integer comparison sorts by distance.
INLINE ulong stack_entry(float distance, uint word) {
    return (ulong)as_uint(distance) << 32 | word;
}
INLINE float entry_distance(ulong entry) {
    return as_float((uint)(entry >> 32));
}

// Waits below everything an instance's tree pushes; no tree has this child word.
#define STACK_LEAVE_INSTANCE ((ulong)BVH_NONE)

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

// Pushes the children in `bits`, of which there are at least two, but for the nearest, which it
// returns; nearer ones lie higher on the stack.
INLINE ulong push_farther(ulong* stack, uint* size, BvhView bvh, __global const uint* children,
                          const float* near, uint bits) {
    NEXT_ENTRY(a)
    NEXT_ENTRY(b)
    bvh_prefetch(bvh, (uint)b);
    ulong* top = stack + *size;
    if (!bits) {
        SORT_DESCENDING(a, b)
        top[0] = a;
        *size += 1;
        return b;
    }
    NEXT_ENTRY(c)
    bvh_prefetch(bvh, (uint)c);
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
    bvh_prefetch(bvh, (uint)d);
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
        bvh_prefetch(bvh, (uint)e);
        SORT_DESCENDING(e, d)
        uint i = (*size)++;
        for (; stack + i > top && stack[i - 1] < e; i--) stack[i] = stack[i - 1];
        stack[i] = e;
    }
    return d;
}

// The view as single arguments of a function that is not inlined: a struct would go through memory,
// which a short walk feels.
#define BVH_SCALARS                                                                                \
    __global const uchar *nodes, __global const uchar *blocks, __global const BvhSphere *spheres,  \
        __global const BvhInstance *instances, uint root
#define BVH_TO_SCALARS(bvh) bvh.nodes, bvh.blocks, bvh.spheres, bvh.instances, bvh.root
#define BVH_FROM_SCALARS                                                                           \
    { nodes, blocks, spheres, instances, root }

// A ray in the space of the tree that it walks.
typedef struct {
    float3 origin, direction;
    SlabRay slab;
    float entry;   // no box of the tree is entered earlier
    uint instance; // that the tree is of; BVH_NONE: the world's
} PlacedRay;

INLINE PlacedRay place_ray(float3 origin, float3 direction, float entry, uint instance) {
    const PlacedRay ray = {origin, direction, make_slab_ray(origin, direction), entry, instance};
    return ray;
}
INLINE PlacedRay place_in_instance(BvhView bvh, uint instance, float3 origin, float3 direction,
                                   float entry) {
    __global const float* rows = bvh.instances[instance].world_to_object;
    return place_ray(transform_point(rows, origin), transform_vector(rows, direction), entry,
                     instance);
}

// `hit`, or the closest hit below the child `word`, whose box `ray` enters at `distance`. The stack
// is what is free of it. `start` is the ray in the space in which the walk begins.
INLINE Hit closest_below(BvhView bvh, uint word, float distance, PlacedRay start, float t_min,
                         ulong* stack, Hit hit) {
    float near[BVH_WIDTH] __attribute__((aligned(64)));
    uint size = 0;
    PlacedRay ray = start;
#if ONDE_COUNT_TESTS
    uint boxes = 0, primitives = 0;
#endif
    for (;;) {
        if (!(word & BVH_LEAF)) {
            __global const uchar* node = bvh_node(bvh, word);
            __global const uint* children = bvh_children(node);
            COUNT_TESTS(boxes, count_children(children));
            const NodeHits hits = meet_node(node, ray.slab, ray.entry, hit.t);
            if (hits.bits) {
                *(float16*)near = hits.near;
                const uint first = lowest_bit(hits.bits);
                word = children[first];
                distance = near[first];
                if (hits.bits & (hits.bits - 1)) {
                    const ulong nearest =
                        push_farther(stack, &size, bvh, children, near, hits.bits);
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
            ray = place_in_instance(bvh, instance, start.origin, start.direction, distance);
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
#if ONDE_COUNT_TESTS
                hit.boxes = boxes;
                hit.primitives = primitives;
#endif
                const Hit closest = hit;
                return closest;
            }
            size--;
            distance = entry_distance(stack[size]);
        } while (distance > hit.t);
        word = (uint)stack[size];
    }
}

OUTLINED Hit walk_closest(BVH_SCALARS, float3 origin, float t_min, float3 direction, float t_max) {
    const BvhView bvh = BVH_FROM_SCALARS;
    const Hit miss = {t_max, 0.0f, 0.0f, BVH_NONE, BVH_NONE};
    if (!is_finite_ray(origin, direction)) return miss;
    ulong stack[ONDE_STACK_SIZE];
    return closest_below(bvh, bvh.root, t_min, place_ray(origin, direction, t_min, BVH_NONE), t_min,
                         stack, miss);
}

OUTLINED uint walk_occluded(BVH_SCALARS, float3 origin, float t_min, float3 direction,
                            float t_max) {
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
                // walk.
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
            __global const BvhInstance* placed = bvh.instances + (word & BVH_INDEX_MASK);
            local_origin = transform_point(placed->world_to_object, origin);
            local_direction = transform_vector(placed->world_to_object, direction);
            slab = make_slab_ray(local_origin, local_direction);
            stack[size++] = BVH_NONE;
            word = placed->root;
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

// The closest hit of the ray.
INLINE Hit bvh_closest(BvhView bvh, float3 origin, float t_min, float3 direction, float t_max) {
    return walk_closest(BVH_TO_SCALARS(bvh), origin, t_min, direction, t_max);
}

// Whether anything is hit: 1 or 0.
INLINE uint bvh_occluded(BvhView bvh, float3 origin, float t_min, float3 direction, float t_max) {
    return walk_occluded(BVH_TO_SCALARS(bvh), origin, t_min, direction, t_max);
}

#endif
