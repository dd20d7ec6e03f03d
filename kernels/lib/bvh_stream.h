// The tree, walked by 16 rays in company, whatever their directions: each entry of the stack is a
// child and the rays that meet its box. A node is read once for all of them; rays test it one after
// the other, without a branch in between, so that the processor overlaps their work and mispredicts
// once a node instead of once a ray. After Barringer and Akenine-Moeller, "Dynamic ray stream
// traversal", 2014. Answers are those of the walks in bvh.h, bit for bit.
#ifndef ONDE_LIB_BVH_STREAM_H
#define ONDE_LIB_BVH_STREAM_H

#include "lib/bvh.h"

#define STREAM_WIDTH 16

// Rows by ray. `inverse`, `near`, `far` and `plane` as in SlabRay.
typedef struct {
    float origin[3][STREAM_WIDTH], direction[3][STREAM_WIDTH];
    float inverse[3][STREAM_WIDTH], near[3][STREAM_WIDTH], far[3][STREAM_WIDTH];
    uint plane[3][STREAM_WIDTH];
} StreamRays;

INLINE float16 safe_inverse16(float16 direction) {
    return 1.0f / (fabs(direction) < 1e-18f ? copysign((float16)(1e-18f), direction) : direction);
}

// What the slab test needs of one axis of all rays; `reach` as in make_slab_ray, where watertight.
INLINE void prepare_axis(StreamRays* rays, uint axis, float16 reach) {
    const float16 inverse = safe_inverse16(vload16(0, rays->direction[axis]));
    const float16 start = -vload16(0, rays->origin[axis]) * inverse;
#if ONDE_WATERTIGHT
    const float16 slack = fabs(inverse) * reach;
#else
    const float16 slack = fabs(start) * SLAB_SLACK;
#endif
    vstore16(inverse, 0, rays->inverse[axis]);
    vstore16(start - slack, 0, rays->near[axis]);
    vstore16(start + slack, 0, rays->far[axis]);
    const int16 low = (int16)((int)(128 * axis)), high = (int16)((int)(128 * axis + 64));
    vstore16(as_uint16(inverse < 0.0f ? high : low), 0, rays->plane[axis]);
}

// Fills in all that follows from origin and direction.
INLINE void prepare_stream(StreamRays* rays) {
    const float16 reach = WATERTIGHT_SLACK * UPPER(fabs(vload16(0, rays->origin[0])),
                                                   UPPER(fabs(vload16(0, rays->origin[1])),
                                                         fabs(vload16(0, rays->origin[2]))));
    prepare_axis(rays, 0, reach);
    prepare_axis(rays, 1, reach);
    prepare_axis(rays, 2, reach);
}

INLINE float3 stream_origin(const StreamRays* rays, uint r) {
    return (float3)(rays->origin[0][r], rays->origin[1][r], rays->origin[2][r]);
}
INLINE float3 stream_direction(const StreamRays* rays, uint r) {
    return (float3)(rays->direction[0][r], rays->direction[1][r], rays->direction[2][r]);
}

INLINE uint finite_stream(const StreamRays* rays) {
    float16 sum = 0.0f;
    for (uint axis = 0; axis < 3; axis++)
        sum += (vload16(0, rays->origin[axis]) + vload16(0, rays->direction[axis])) * 0.0f;
    return bits16(sum == 0.0f);
}

// Where ray r enters the node's 16 boxes, and where it leaves them.
typedef struct {
    float16 near, far;
} BoxSpans;

INLINE BoxSpans span_boxes(__global const uchar* node, const StreamRays* rays, uint r, float t_min,
                           float t_max) {
    const uint x = rays->plane[0][r], y = rays->plane[1][r], z = rays->plane[2][r];
    const float ix = rays->inverse[0][r], iy = rays->inverse[1][r], iz = rays->inverse[2][r];
    const float16 near_x = slab_distance(node, x, ix, rays->near[0][r]);
    const float16 near_y = slab_distance(node, y, iy, rays->near[1][r]);
    const float16 near_z = slab_distance(node, z, iz, rays->near[2][r]);
    const float16 far_x = slab_distance(node, x ^ 64, ix, rays->far[0][r]);
    const float16 far_y = slab_distance(node, y ^ 64, iy, rays->far[1][r]);
    const float16 far_z = slab_distance(node, z ^ 64, iz, rays->far[2][r]);
    const float16 near_xy = UPPER(near_x, near_y), near_zt = UPPER(near_z, (float16)(t_min));
    const float16 far_xy = LOWER(far_x, far_y), far_zt = LOWER(far_z, (float16)(t_max));
    const BoxSpans spans = {UPPER(near_xy, near_zt), LOWER(far_xy, far_zt)};
    return spans;
}

// A child, and the rays that meet its box.
INLINE ulong stream_entry(uint word, uint rays) {
    return (ulong)rays << 32 | word;
}

#if ONDE_INSTANCES
// The rays in the space of an instance.
INLINE void place_stream(StreamRays* inside, const StreamRays* world,
                         __global const BvhInstance* placed) {
    __global const float* m = placed->world_to_object;
    const float16 px = vload16(0, world->origin[0]), py = vload16(0, world->origin[1]),
                  pz = vload16(0, world->origin[2]);
    const float16 vx = vload16(0, world->direction[0]), vy = vload16(0, world->direction[1]),
                  vz = vload16(0, world->direction[2]);
    for (uint row = 0; row < 3; row++, m += 4) {
        const float16 a = m[0], b = m[1], c = m[2], d = m[3];
        vstore16(fma(a, px, fma(b, py, fma(c, pz, d))), 0, inside->origin[row]);
        vstore16(fma(a, vx, fma(b, vy, c * vz)), 0, inside->direction[row]);
    }
    prepare_stream(inside);
}
#endif

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
    int16 met = 0;
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const BoxSpans spans = span_boxes(node, rays, r, t_min[r], t_max[r]);
        met |= (spans.near <= spans.far) & (int16)((int)(1u << r));
    }
    uint rays_of[BVH_WIDTH] __attribute__((aligned(64)));
    *(uint16*)rays_of = as_uint16(met);
    __global const uint* children = bvh_children(node);
    for (uint slots = bits16(met != 0); slots;) {
        const uint slot = 31u - clz(slots);
        slots ^= 1u << slot;
        bvh_prefetch(bvh, children[slot]);
        stack[size++] = stream_entry(children[slot], rays_of[slot]);
    }
    return size;
}

// Those of the rays in `bits` that are blocked in (t_min, t_max]. Of `rays`, origin and direction
// of all 16 must be numbers.
OUTLINED uint bvh_occluded_stream(BVH_SCALARS, StreamRays* world, const float* t_min,
                                  const float* t_max, uint bits) {
    const BvhView bvh = BVH_FROM_SCALARS;
    prepare_stream(world);
    uint open = bits & finite_stream(world), blocked = 0; // rays that nothing blocks so far
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
            __global const BvhInstance* placed = bvh.instances + (word & BVH_INDEX_MASK);
            place_stream(&inside, world, placed);
            rays = &inside;
            stack[size++] = stream_entry(BVH_NONE, 0xffffu);
            word = placed->root;
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

// Closest hits so far, rows by ray; `t` is t_max where there is none.
typedef struct {
    float t[STREAM_WIDTH], u[STREAM_WIDTH], v[STREAM_WIDTH];
    uint primitive[STREAM_WIDTH], instance[STREAM_WIDTH];
} StreamHits;

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

// Where the rays enter one box by one axis, and leave it.
INLINE float16 box_entry(__global const float* box, uint axis, const StreamRays* rays) {
    const float16 low = box[32 * axis], high = box[32 * axis + 16];
    const float16 inverse = vload16(0, rays->inverse[axis]);
    return fma(inverse < 0.0f ? high : low, inverse, vload16(0, rays->near[axis]));
}
INLINE float16 box_exit(__global const float* box, uint axis, const StreamRays* rays) {
    const float16 low = box[32 * axis], high = box[32 * axis + 16];
    const float16 inverse = vload16(0, rays->inverse[axis]);
    return fma(inverse < 0.0f ? low : high, inverse, vload16(0, rays->far[axis]));
}

// All rays against the box in a slot of a node: as span_boxes, ray by ray.
INLINE BoxSpans span_rays(__global const float* box, const StreamRays* rays, const float* entry,
                          const float* t_max) {
    const float16 near_xy = UPPER(box_entry(box, 0, rays), box_entry(box, 1, rays));
    const float16 near_zt = UPPER(box_entry(box, 2, rays), vload16(0, entry));
    const float16 far_xy = LOWER(box_exit(box, 0, rays), box_exit(box, 1, rays));
    const float16 far_zt = LOWER(box_exit(box, 2, rays), vload16(0, t_max));
    const BoxSpans spans = {UPPER(near_xy, near_zt), LOWER(far_xy, far_zt)};
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
        const BoxSpans spans = span_boxes(node, rays, r, entry[r], t_max[r]);
        const int16 meets = spans.near <= spans.far;
        met |= meets & (int16)((int)(1u << r));
        const float16 near = meets ? spans.near : (float16)(INFINITY);
        nearest = LOWER(nearest, near);
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

// The rays in `bits` against what hangs in a leaf.
INLINE void meet_leaf(BvhView bvh, uint word, const StreamRays* rays, const float* t_min,
                      const float* near, uint instance, StreamHits* hits, uint bits) {
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const float3 origin = stream_origin(rays, r), direction = stream_direction(rays, r);
        Hit hit = stream_hit(hits, r);
        if ((word & BVH_KIND_MASK) == BVH_LEAF_TRIANGLES)
            hit = closest_in_block(bvh_block(bvh, word), origin, t_min[r], direction, near[r],
                                   instance, hit);
#if ONDE_SPHERES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_SPHERE)
            hit = closest_on_sphere(bvh.spheres[word & BVH_INDEX_MASK], origin, t_min[r], direction,
                                    near[r], instance, hit);
#endif
#if ONDE_SHAPES
        else
            hit = closest_on_shape(bvh.spheres[word & BVH_INDEX_MASK], origin, t_min[r], direction,
                                   near[r], instance, hit);
#endif
        set_stream_hit(hits, r, hit);
    }
}

// At most so many rays go on one by one.
#ifndef STREAM_ALONE
    #define STREAM_ALONE 2
#endif

INLINE PlacedRay stream_ray(const StreamRays* rays, uint r, float entry, uint instance) {
    PlacedRay ray = {stream_origin(rays, r), stream_direction(rays, r)};
    ray.slab.inverse = (float3)(rays->inverse[0][r], rays->inverse[1][r], rays->inverse[2][r]);
    ray.slab.near = (float3)(rays->near[0][r], rays->near[1][r], rays->near[2][r]);
    ray.slab.far = (float3)(rays->far[0][r], rays->far[1][r], rays->far[2][r]);
    ray.slab.plane = (uint3)(rays->plane[0][r], rays->plane[1][r], rays->plane[2][r]);
    ray.entry = entry;
    ray.instance = instance;
    return ray;
}

// The closest hits of the rays in `bits`; those of the others are left as they are. On entry
// hits->t is t_max.
OUTLINED void bvh_closest_stream(BVH_SCALARS, StreamRays* world, const float* t_min,
                                 StreamHits* hits, uint bits) {
    const BvhView bvh = BVH_FROM_SCALARS;
    prepare_stream(world);
    uint here = bits & finite_stream(world);
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
    if (!here) return;
    for (;;) {
        if (!(word & BVH_LEAF) && popcount(here) <= STREAM_ALONE) {
            for (uint rest = here; rest; rest &= rest - 1) {
                const uint r = lowest_bit(rest);
                set_stream_hit(hits, r,
                               closest_below(bvh, word, near[r],
                                             stream_ray(rays, r, entry[r], instance), t_min[r],
                                             stack + size, stream_hit(hits, r)));
            }
        } else if (!(word & BVH_LEAF)) {
            size = push_nearest_last(stack, size, bvh, word, rays, entry, hits->t, here);
        }
#if ONDE_INSTANCES
        else if ((word & BVH_KIND_MASK) == BVH_LEAF_INSTANCE) {
            instance = word & BVH_INDEX_MASK;
            __global const BvhInstance* placed = bvh.instances + instance;
            place_stream(&inside, world, placed);
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
        do {
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
        } while (!here);
    }
}

#endif
