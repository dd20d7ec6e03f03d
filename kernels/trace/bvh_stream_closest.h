// Closest hits of 16 rays in company. Nearer children come first, as the last of the rays that meet
// them has it; when few rays are left below a child they go on one by one.
#ifndef ONDE_TRACE_BVH_STREAM_CLOSEST_H
#define ONDE_TRACE_BVH_STREAM_CLOSEST_H

#include "trace/bvh_stream.h"

// Closest hits so far, rows by ray; `t` is t_max where there is none.
typedef struct {
    float t[STREAM_WIDTH], u[STREAM_WIDTH], v[STREAM_WIDTH];
    uint primitive[STREAM_WIDTH], instance[STREAM_WIDTH];
} StreamHits;

INLINE void clear_stream_hits(StreamHits* hits, float16 t_max) {
    vstore16(t_max, 0, hits->t);
    vstore16((float16)(0.0f), 0, hits->u);
    vstore16((float16)(0.0f), 0, hits->v);
    vstore16((uint16)(BVH_NONE), 0, hits->primitive);
    vstore16((uint16)(BVH_NONE), 0, hits->instance);
}
INLINE Hit stream_hit(const StreamHits* hits, uint r) {
    const Hit hit = {hits->t[r], hits->u[r], hits->v[r], hits->primitive[r], hits->instance[r]};
    return hit;
}
INLINE void set_stream_hit(StreamHits* hits, uint r, Hit hit) {
    hits->t[r] = hit.t;
    hits->u[r] = hit.u;
    hits->v[r] = hit.v;
    hits->primitive[r] = hit.primitive;
    hits->instance[r] = hit.instance;
}

// What waits on the stack: the distance's upper half, which only orders, then the rays, then the
// child by its node and slot.
INLINE ulong slot_entry(float distance, uint rays, uint node, uint slot) {
    return (ulong)(as_uint(distance) >> 16) << 48 | (ulong)rays << 32 | (node * BVH_WIDTH + slot);
}
INLINE uint entry_rays(ulong entry) {
    return (uint)(entry >> 32) & 0xffffu;
}

// Where the rays enter one box by one axis, and leave it. `select` goes by the sign of the inverse.
INLINE float16 box_entry(__global const float* box, uint axis, const StreamRays* rays) {
    const float16 low = box[32 * axis], high = box[32 * axis + 16];
    const float16 inverse = vload16(0, rays->inverse[axis]);
    return fma(select(low, high, as_int16(inverse)), inverse, vload16(0, rays->near[axis]));
}
INLINE float16 box_exit(__global const float* box, uint axis, const StreamRays* rays) {
    const float16 low = box[32 * axis], high = box[32 * axis + 16];
    const float16 inverse = vload16(0, rays->inverse[axis]);
    return fma(select(high, low, as_int16(inverse)), inverse, vload16(0, rays->far[axis]));
}

// All rays against the box in a slot of a node: as span_boxes, ray by ray.
INLINE BoxSpans span_rays(__global const float* box, const StreamRays* rays, const float* entry,
                          const float* t_max) {
    const float16 near_xy = max_fast(box_entry(box, 0, rays), box_entry(box, 1, rays));
    const float16 near_zt = max_fast(box_entry(box, 2, rays), vload16(0, entry));
    const float16 far_xy = min_fast(box_exit(box, 0, rays), box_exit(box, 1, rays));
    const float16 far_zt = min_fast(box_exit(box, 2, rays), vload16(0, t_max));
    const BoxSpans spans = {max_fast(near_xy, near_zt), min_fast(far_xy, far_zt)};
    return spans;
}

// Pushes the children that rays in `bits` meet, the nearest last.
INLINE uint push_nearest_last(ulong* stack, uint size, BvhView bvh, uint word,
                              const StreamRays* rays, const float* entry, const float* t_max,
                              uint bits) {
    __global const uchar* node = bvh_node(bvh, word);
    int16 met = 0;
    float16 nearest = INFINITY;
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const BoxSpans spans = span_boxes(node, stream_slab(rays, r), entry[r], t_max[r]);
        const int16 meets = spans.near <= spans.far;
        met |= meets & ray_bit16(r);
        nearest = meets ? spans.near : nearest;
    }
    uint rays_of[BVH_WIDTH] __attribute__((aligned(64)));
    float near_of[BVH_WIDTH] __attribute__((aligned(64)));
    *(uint16*)rays_of = as_uint16(met);
    *(float16*)near_of = nearest;
    __global const uint* children = bvh_children(node);
    const uint first = size;
    for (uint slots = bits16(met != 0); slots; slots &= slots - 1) {
        const uint slot = lowest_bit(slots);
        bvh_prefetch(bvh, children[slot]);
        const ulong waiting = slot_entry(near_of[slot], rays_of[slot], word, slot);
        uint i = size++;
        for (; i > first && stack[i - 1] < waiting; i--) stack[i] = stack[i - 1];
        stack[i] = waiting;
    }
    return size;
}

// The rays in `bits` against a block of triangles.
INLINE void meet_block(__global const uchar* block, const StreamRays* rays, const float* t_min,
                       const float* near, uint instance, StreamHits* hits, uint bits) {
    const BlockTriangles triangles = block_triangles(block);
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const TriangleTest8 test =
            test_block(triangles, stream_origin(rays, r), stream_direction(rays, r));
        const int8 miss = miss8(test, (float8)(t_min[r]), (float8)(hits->t[r]));
        if (sign_bits8(miss) != 0xffu)
            set_stream_hit(hits, r,
                           closest_of_block(block, test, miss, t_min[r], near[r], instance,
                                            stream_hit(hits, r)));
    }
}

// The rays in `bits` against what hangs in a leaf.
INLINE void meet_leaf(BvhView bvh, uint word, const StreamRays* rays, const float* t_min,
                      const float* near, uint instance, StreamHits* hits, uint bits) {
    if ((word & BVH_KIND_MASK) == BVH_LEAF_TRIANGLES) {
        meet_block(bvh_block(bvh, word), rays, t_min, near, instance, hits, bits);
        return;
    }
#if ONDE_SPHERES || ONDE_SHAPES
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const float3 origin = stream_origin(rays, r), direction = stream_direction(rays, r);
        const BvhSphere primitive = bvh.spheres[word & BVH_INDEX_MASK];
        Hit hit = stream_hit(hits, r);
    #if ONDE_SPHERES
        if ((word & BVH_KIND_MASK) == BVH_LEAF_SPHERE)
            hit = closest_on_sphere(primitive, origin, t_min[r], direction, near[r], instance, hit);
    #endif
    #if ONDE_SHAPES
        if ((word & BVH_KIND_MASK) == BVH_LEAF_SHAPE)
            hit = closest_on_shape(primitive, origin, t_min[r], direction, near[r], instance, hit);
    #endif
        set_stream_hit(hits, r, hit);
    }
#endif
}

// At most so many rays go on one by one.
#ifndef STREAM_ALONE
    #define STREAM_ALONE 2
#endif

INLINE PlacedRay stream_ray(const StreamRays* rays, uint r, float entry, uint instance) {
    const PlacedRay ray = {stream_origin(rays, r), stream_direction(rays, r), stream_slab(rays, r),
                           entry, instance};
    return ray;
}

// The rays in `bits` below an inner node, one after the other.
INLINE void go_on_alone(BvhView bvh, uint word, const StreamRays* rays, const float* t_min,
                        const float* near, const float* entry, uint instance, ulong* stack,
                        StreamHits* hits, uint bits) {
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const PlacedRay ray = stream_ray(rays, r, entry[r], instance);
        set_stream_hit(
            hits, r, closest_below(bvh, word, near[r], ray, t_min[r], stack, stream_hit(hits, r)));
    }
}

// The closest hits of the rays in `bits`; those of the others are left as they are. On entry
// `hits` are clear.
OUTLINED void bvh_closest_stream(BVH_SCALARS, StreamRays* world, const float* t_min,
                                 StreamHits* hits, uint bits) {
    const BvhView bvh = BVH_FROM_SCALARS;
    prepare_stream(world, 1);
    uint here = bits & finite_stream(world, 1);
    const StreamRays* rays = world;
    float near[STREAM_WIDTH] __attribute__((aligned(64)));
    const float* entry = t_min; // no box of the current tree is entered earlier
    uint instance = BVH_NONE;
#if ONDE_INSTANCES
    StreamRays inside;
    float inside_entry[STREAM_WIDTH] __attribute__((aligned(64)));
#endif
    ulong stack[ONDE_STACK_SIZE];
    uint size = 0, word = bvh.root;
    *(float16*)near = vload16(0, t_min);
    // A single loop: one of its own for entries that no ray meets any more would make the compiler
    // copy the rays' rows to its stack whenever it is entered.
    for (;;) {
        if (!(word & BVH_LEAF)) {
            if (popcount(here) <= STREAM_ALONE)
                go_on_alone(bvh, word, rays, t_min, near, entry, instance, stack + size, hits,
                            here);
            else
                size = push_nearest_last(stack, size, bvh, word, rays, entry, hits->t, here);
        }
#if ONDE_INSTANCES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_INSTANCE && here) {
            instance = word & BVH_INDEX_MASK;
            __global const BvhInstance* placed = bvh.instances + instance;
            place_stream(&inside, world, placed, 1);
            rays = &inside;
            *(float16*)inside_entry = *(float16*)near;
            entry = inside_entry;
            stack[size++] = STACK_LEAVE_INSTANCE;
            word = placed->root;
            continue;
        }
#endif
        else
            meet_leaf(bvh, word, rays, t_min, near, instance, hits, here);
        if (size == 0) return;
        const ulong waiting = stack[--size];
#if ONDE_INSTANCES
        if (waiting == STACK_LEAVE_INSTANCE) {
            instance = BVH_NONE;
            rays = world;
            entry = t_min;
            here = 0;
            continue;
        }
#endif
        const uint slot = (uint)waiting % BVH_WIDTH;
        __global const uchar* parent = bvh_node(bvh, (uint)waiting / BVH_WIDTH);
        const BoxSpans spans =
            span_rays((__global const float*)parent + slot, rays, entry, hits->t);
        *(float16*)near = spans.near;
        here = bits16(spans.near <= spans.far) & entry_rays(waiting);
        word = bvh_children(parent)[slot];
    }
}

#endif
