// Closest hits of a ray stream of 16. Nearer children come first, as the last of the rays that meet
// them has it; when few rays are left below a child they go on one by one.
#ifndef ONDE_TRACE_BVH_STREAM_CLOSEST_H
#define ONDE_TRACE_BVH_STREAM_CLOSEST_H

#include "trace/bvh_beam.h"

// Closest hits so far, rows by ray; `t` is t_max where there is none.
typedef struct {
    float t[STREAM_WIDTH], u[STREAM_WIDTH], v[STREAM_WIDTH];
    uint primitive[STREAM_WIDTH], instance[STREAM_WIDTH];
} StreamHits;

INLINE void clear_stream_hits(StreamHits* hits, real16 t_max) {
    vstore16(t_max, 0, hits->t);
    vstore16((real16)(0.0f), 0, hits->u);
    vstore16((real16)(0.0f), 0, hits->v);
    vstore16((natural16)(BVH_NONE), 0, hits->primitive);
    vstore16((natural16)(BVH_NONE), 0, hits->instance);
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

// Where the rays cross the planes of an axis of one box that they come to first, and last, by the
// sign of the inverse.
INLINE real16 near_planes(__global const float* box, uint axis, const StreamRays* rays) {
    const real16 low = box[32 * axis], high = box[32 * axis + 16];
    return select(low, high, as_mask16(vload16(0, rays->inverse[axis])));
}
INLINE real16 far_planes(__global const float* box, uint axis, const StreamRays* rays) {
    const real16 low = box[32 * axis], high = box[32 * axis + 16];
    return select(high, low, as_mask16(vload16(0, rays->inverse[axis])));
}

INLINE BoxSpans span_planes(Vectors16 near, Vectors16 far, const StreamRays* rays,
                            const float* entry, const float* t_max) {
    const real16 x = vload16(0, rays->inverse[0]), y = vload16(0, rays->inverse[1]),
                 z = vload16(0, rays->inverse[2]);
    const real16 near_x = fma(near.x, x, vload16(0, rays->near[0]));
    const real16 near_y = fma(near.y, y, vload16(0, rays->near[1]));
    const real16 near_z = fma(near.z, z, vload16(0, rays->near[2]));
    const real16 far_x = fma(far.x, x, vload16(0, rays->far[0]));
    const real16 far_y = fma(far.y, y, vload16(0, rays->far[1]));
    const real16 far_z = fma(far.z, z, vload16(0, rays->far[2]));
    const real16 near_xy = max_fast(near_x, near_y), near_zt = max_fast(near_z, vload16(0, entry));
    const real16 far_xy = min_fast(far_x, far_y), far_zt = min_fast(far_z, vload16(0, t_max));
    const BoxSpans spans = {max_fast(near_xy, near_zt), min_fast(far_xy, far_zt)};
    return spans;
}

// All rays against the box in a slot of a node: as span_boxes, ray by ray.
INLINE BoxSpans span_rays(__global const float* box, const StreamRays* rays, const Beam* beam,
                          const float* entry, const float* t_max) {
    if (beam->valid) {
        const uint x = beam->plane.x / 4, y = beam->plane.y / 4, z = beam->plane.z / 4;
        const Vectors16 near = {box[x], box[y], box[z]};
        const Vectors16 far = {box[x ^ 16], box[y ^ 16], box[z ^ 16]};
        return span_planes(near, far, rays, entry, t_max);
    }
    const Vectors16 near = {near_planes(box, 0, rays), near_planes(box, 1, rays),
                            near_planes(box, 2, rays)};
    const Vectors16 far = {far_planes(box, 0, rays), far_planes(box, 1, rays),
                           far_planes(box, 2, rays)};
    return span_planes(near, far, rays, entry, t_max);
}

// What the rays meet of the children of a node: which of the rays, and where about.
typedef struct {
    uint rays[BVH_WIDTH] __attribute__((aligned(64)));
    float near[BVH_WIDTH] __attribute__((aligned(64)));
} ChildrenMet;

// Ray by ray against all children. Returns those that are met.
INLINE uint meet_ray_by_ray(__global const uchar* node, const StreamRays* rays, const float* entry,
                            const float* t_max, uint bits, ChildrenMet* children) {
    mask16 met = 0;
    real16 nearest = INFINITY;
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const BoxSpans spans = span_boxes(node, stream_slab(rays, r), entry[r], t_max[r]);
        const mask16 meets = spans.near <= spans.far;
        met |= meets & ray_bit16(r);
        nearest = meets ? spans.near : nearest;
    }
    *(natural16*)children->rays = as_natural16(met);
    *(real16*)children->near = nearest;
    return bits16(met != 0);
}

// Those in the way of the rays' beam, whichever rays meet them.
INLINE uint meet_as_beam(NodeHits way, uint bits, ChildrenMet* children) {
    *(natural16*)children->rays = (natural16)(bits);
    *(real16*)children->near = way.near;
    return way.bits;
}

// Pushes the children that rays in `bits` meet, the nearest last.
INLINE uint push_nearest_last(ulong* stack, uint size, BvhView bvh, uint word,
                              const StreamRays* rays, const Beam* beam, const float* entry,
                              const float* t_max, uint bits) {
    __global const uchar* node = bvh_node(bvh, word);
    ChildrenMet met;
    NodeHits way = {0.0f, 0xffffu};
    if (beam->valid) way = beam_meets_node(node, beam);
    uint slots = popcount(way.bits) < popcount(bits)
                     ? meet_as_beam(way, bits, &met)
                     : meet_ray_by_ray(node, rays, entry, t_max, bits, &met);
    __global const uint* children = bvh_children(node);
    const uint first = size;
    for (; slots; slots &= slots - 1) {
        const uint slot = lowest_bit(slots);
        bvh_prefetch(bvh, children[slot]);
        const ulong waiting = slot_entry(met.near[slot], met.rays[slot], word, slot);
        uint i = size++;
        for (; i > first && stack[i - 1] < waiting; i--) stack[i] = stack[i - 1];
        stack[i] = waiting;
    }
    return size;
}

// The rays in `bits` against a block of triangles, ray by ray.
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

// From so many rays on a block is tested triangle by triangle. A triangle costs two vectors of 8
// rays, or one of 16, and a ray one of 8 triangles, of which six or so are there.
#define STREAM_MANY (ONDE_AVX512 ? 7 : 13)

INLINE Vectors16 stream_vectors(const float rows[3][OCCLUDED_WIDTH]) {
    const Vectors16 vectors = {vload16(0, rows[0]), vload16(0, rows[1]), vload16(0, rows[2])};
    return vectors;
}
INLINE Vectors16 splat16(__global const float* rows, uint i) {
    const Vectors16 vectors = {(real16)(rows[i]), (real16)(rows[8 + i]), (real16)(rows[16 + i])};
    return vectors;
}

// As meet_block, triangle by triangle.
INLINE void meet_triangles(__global const uchar* block, const StreamRays* rays, const float* t_min,
                           const float* near, uint instance, StreamHits* hits, uint bits) {
    __global const float* rows = (__global const float*)block;
    const Vectors16 origin = stream_vectors(rays->origin);
    const Vectors16 direction = stream_vectors(rays->direction);
    for (uint i = 0; i < BVH_LEAF_WIDTH; i++) {
        const uint primitive = as_uint(rows[72 + i]);
        if (primitive == BVH_NONE) return;
        const TriangleTest16 test = leaf_test16(origin, direction, splat16(rows, i),
                                                splat16(rows + 24, i), splat16(rows + 48, i));
        if (!(bits & ~sign_bits16(test.outside))) continue;
        const real16 t_max = vload16(0, hits->t);
        const mask16 miss = miss16(test, vload16(0, t_min), t_max);
        if (!(bits & ~sign_bits16(miss))) continue;
        const real16 inverse = 1.0f / test.determinant;
        const real16 t = test.t * inverse, from_box = max_fast(t, vload16(0, near));
        const natural16 primitives = vload16(0, hits->primitive);
        const natural16 instances = vload16(0, hits->instance);
        const mask16 first = ((natural16)(primitive) < primitives) |
                             (((natural16)(primitive) == primitives) & (instance < instances));
        const mask16 closer = lanes16(bits) & (miss >= 0) & (t > vload16(0, t_min)) &
                              ((from_box < t_max) | ((from_box == t_max) & first));
        vstore16(closer ? from_box : t_max, 0, hits->t);
        vstore16(closer ? test.u * inverse : vload16(0, hits->u), 0, hits->u);
        vstore16(closer ? test.v * inverse : vload16(0, hits->v), 0, hits->v);
        vstore16(closer ? (natural16)(primitive) : primitives, 0, hits->primitive);
        vstore16(closer ? (natural16)(instance) : instances, 0, hits->instance);
    }
}

// The rays in `bits` against what a leaf holds.
INLINE void meet_leaf(BvhView bvh, uint word, const StreamRays* rays, const float* t_min,
                      const float* near, uint instance, StreamHits* hits, uint bits) {
    if ((word & BVH_KIND_MASK) == BVH_LEAF_TRIANGLES) {
        if (popcount(bits) < STREAM_MANY)
            meet_block(bvh_block(bvh, word), rays, t_min, near, instance, hits, bits);
        else
            meet_triangles(bvh_block(bvh, word), rays, t_min, near, instance, hits, bits);
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
                           entry, instance TIME(rays->time[r])};
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
    Beam beam;
    make_beam(&beam, rays, t_min, here);
#if ONDE_INSTANCES
    StreamRays inside;
    float inside_entry[STREAM_WIDTH] __attribute__((aligned(64)));
#endif
    ulong stack[ONDE_STACK_SIZE];
    uint size = 0, word = bvh.root;
    *(real16*)near = vload16(0, t_min);
    // A single loop: one of its own for entries that no ray meets any more would make the compiler
    // copy the rays' rows to its stack whenever it is entered.
    for (;;) {
        if (!(word & BVH_LEAF)) {
            if (popcount(here) <= STREAM_ALONE)
                go_on_alone(bvh, word, rays, t_min, near, entry, instance, stack + size, hits,
                            here);
            else
                size = push_nearest_last(stack, size, bvh, word, rays, &beam, entry, hits->t, here);
        }
#if ONDE_INSTANCES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_INSTANCE && here) {
            instance = word & BVH_INDEX_MASK;
            place_stream(&inside, world, bvh, instance, 1);
            rays = &inside;
            make_beam(&beam, rays, t_min, here);
            *(real16*)inside_entry = *(real16*)near;
            entry = inside_entry;
            stack[size++] = STACK_LEAVE_INSTANCE;
            word = bvh.instances[instance].root;
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
            make_beam(&beam, rays, t_min, bits);
            here = 0;
            continue;
        }
#endif
        const uint slot = (uint)waiting % BVH_WIDTH;
        __global const uchar* parent = bvh_node(bvh, (uint)waiting / BVH_WIDTH);
        const BoxSpans spans =
            span_rays((__global const float*)parent + slot, rays, &beam, entry, hits->t);
        *(real16*)near = spans.near;
        here = bits16(spans.near <= spans.far) & entry_rays(waiting);
        word = bvh_children(parent)[slot];
    }
}

#endif
