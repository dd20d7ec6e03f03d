// Whether anything is hit, by a ray stream of up to 32: a stack entry is a child and the rays that
// meet it.
#ifndef ONDE_TRACE_BVH_STREAM_OCCLUDED_H
#define ONDE_TRACE_BVH_STREAM_OCCLUDED_H

#include "trace/bvh_stream.h"

// A child, and the rays that meet its box.
INLINE ulong stream_entry(uint word, uint rays) {
    return (ulong)rays << 32 | word;
}

// Those of the rays in `bits` that something of the leaf blocks.
INLINE uint blocked_by_leaf(BvhView bvh, uint word, const StreamRays* rays, const float* t_min,
                            const float* t_max, uint bits) {
    uint blocked = 0;
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const float3 origin = stream_origin(rays, r), direction = stream_direction(rays, r);
        uint hit = 0;
        if ((word & BVH_KIND_MASK) == BVH_LEAF_TRIANGLES)
            hit = any_in_block(bvh_block(bvh, word), origin, t_min[r], direction, t_max[r]);
#if ONDE_SPHERES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_SPHERE)
            hit = sphere_distance(bvh.spheres[word & BVH_INDEX_MASK], origin, t_min[r], direction,
                                  t_max[r]) != INFINITY;
#endif
#if ONDE_SHAPES
        else
            hit = shape_distance(bvh.spheres[word & BVH_INDEX_MASK], origin, t_min[r], direction,
                                 t_max[r]) != INFINITY;
#endif
        blocked |= hit << r;
    }
    return blocked;
}

// Pushes the children that rays in `bits` meet, the largest last.
INLINE uint push_met(ulong* stack, uint size, BvhView bvh, uint word, const StreamRays* rays,
                     const float* t_min, const float* t_max, uint bits) {
    __global const uchar* node = bvh_node(bvh, word);
    mask16 met = 0;
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const BoxSpans spans = span_boxes(node, stream_slab(rays, r), t_min[r], t_max[r]);
        met |= (spans.near <= spans.far) & ray_bit16(r);
    }
    uint rays_of[BVH_WIDTH] __attribute__((aligned(64)));
    *(natural16*)rays_of = as_natural16(met);
    __global const uint* children = bvh_children(node);
    for (uint slots = bits16(met != 0); slots;) {
        const uint slot = 31u - clz(slots);
        slots ^= 1u << slot;
        bvh_prefetch(bvh, children[slot]);
        stack[size++] = stream_entry(children[slot], rays_of[slot]);
    }
    return size;
}

// Those of the rays in `bits` that are blocked in (t_min, t_max].
OUTLINED uint bvh_occluded_stream(BVH_SCALARS, StreamRays* world, const float* t_min,
                                  const float* t_max, uint bits) {
    const BvhView bvh = BVH_FROM_SCALARS;
    const uint halves = stream_halves(bits);
    prepare_stream(world, halves);
    uint open = bits & finite_stream(world, halves), blocked = 0; // rays that nothing blocks so far
    const StreamRays* rays = world;
#if ONDE_INSTANCES
    StreamRays inside;
#endif
    ulong stack[ONDE_STACK_SIZE];
    uint size = 0;
    uint word = bvh.root, here = open;
    while (open) {
        if (!(word & BVH_LEAF)) {
            size = push_met(stack, size, bvh, word, rays, t_min, t_max, here);
        }
#if ONDE_INSTANCES
        else if (word == BVH_NONE) {
            rays = world;
        } else if ((word & BVH_KIND_MASK) == BVH_LEAF_INSTANCE) {
            const uint instance = word & BVH_INDEX_MASK;
            place_stream(&inside, world, bvh, instance, halves);
            rays = &inside;
            stack[size++] = stream_entry(BVH_NONE, 0xffffffffu);
            word = bvh.instances[instance].root;
            continue;
        }
#endif
        else {
            const uint hit = blocked_by_leaf(bvh, word, rays, t_min, t_max, here);
            blocked |= hit;
            open &= ~hit;
        }
        do {
            if (size == 0) return blocked;
            size--;
            word = (uint)stack[size];
            here = (uint)(stack[size] >> 32) & open;
        } while (!here);
    }
    return blocked;
}

#endif
