// Closest hits of 16 rays that have nothing in common: each traverses by itself, a step at a time
// after the others. What a step reads is asked for one turn ahead, so that memory answers while the
// other rays make theirs; and as a turn makes one kind of step for all rays before the next kind,
// what each finds seldom makes the processor guess. After the idea of Chen, Ailamaki et al.,
// "Improving hash join performance through prefetching", 2004 (group prefetching). Answers are
// those of bvh_closest, bit for bit.
#ifndef ONDE_TRACE_BVH_INTERLEAVED_H
#define ONDE_TRACE_BVH_INTERLEAVED_H

#include "trace/bvh_stream_closest.h"

// Where each ray stands, by ray.
typedef struct {
    uint word[STREAM_WIDTH];      // the child that it comes to next
    float distance[STREAM_WIDTH]; // where it enters that child's box
    uint size[STREAM_WIDTH];      // of its stack
    ulong stack[STREAM_WIDTH][ONDE_STACK_SIZE];
#if ONDE_INSTANCES
    StreamRays placed; // the rays in the space of the tree that each traverses
    float entry[STREAM_WIDTH];
    uint instance[STREAM_WIDTH]; // as in PlacedRay
#endif
} Interleaved;

// The rays whose next child is a node, and those whose is a leaf.
typedef struct {
    uint nodes, leaves;
} Due;

INLINE Due make_due(Due due, Interleaved* turns, uint r, ulong entry) {
    turns->word[r] = (uint)entry;
    turns->distance[r] = entry_distance(entry);
    const uint leaf = (uint)entry >> 31;
    due.nodes |= (leaf ^ 1) << r;
    due.leaves |= leaf << r;
    return due;
}

// What each ray has met of its node.
typedef struct {
    float near[STREAM_WIDTH][BVH_WIDTH] __attribute__((aligned(64)));
    uint bits[STREAM_WIDTH];
} NodesMet;

INLINE void meet_nodes(NodesMet* met, BvhView bvh, const Interleaved* turns, const StreamRays* rays,
                       const float* entry, const float* t_max, uint bits) {
    for (; bits; bits &= bits - 1) {
        const uint r = lowest_bit(bits);
        const NodeHits hits =
            meet_node(bvh_node(bvh, turns->word[r]), stream_slab(rays, r), entry[r], t_max[r]);
        *(real16*)met->near[r] = hits.near;
        met->bits[r] = hits.bits;
    }
}

// Sends ray r to the nearest of the children that it has met, of which there are some.
INLINE Due descend(Due due, Interleaved* turns, BvhView bvh, const NodesMet* met, uint r) {
    __global const uint* children = bvh_children(bvh_node(bvh, turns->word[r]));
    const uint bits = met->bits[r], first = lowest_bit(bits);
    ulong nearest = stack_entry(met->near[r][first], children[first]);
    if (bits & (bits - 1))
        nearest = push_farther(turns->stack[r], turns->size + r, bvh, children, met->near[r], bits,
                               PREFETCH_NONE);
    bvh_prefetch(bvh, (uint)nearest);
    return make_due(due, turns, r, nearest);
}

// Sends ray r to what waits on its stack, if there is something.
INLINE Due take_waiting(Due due, Interleaved* turns, BvhView bvh, const StreamRays* world,
                        const float* t_min, uint r, float t_max) {
    uint size = turns->size[r];
    while (size > 0) {
        const ulong waiting = turns->stack[r][--size];
#if ONDE_INSTANCES
        if (waiting == STACK_LEAVE_INSTANCE) {
            copy_stream_ray(&turns->placed, world, r);
            turns->entry[r] = t_min[r];
            turns->instance[r] = BVH_NONE;
            continue;
        }
#endif
        if (entry_distance(waiting) > t_max) continue;
        bvh_prefetch(bvh, (uint)waiting);
        due = make_due(due, turns, r, waiting);
        break;
    }
    turns->size[r] = size;
    return due;
}

#if ONDE_INSTANCES
// Sends ray r into the tree of the instance that it has come to.
INLINE Due enter_instance(Due due, Interleaved* turns, BvhView bvh, const StreamRays* world,
                          uint r) {
    const uint instance = turns->word[r] & BVH_INDEX_MASK;
    const float distance = turns->distance[r];
    set_stream_ray(&turns->placed, r,
                   place_in_instance(bvh, instance, stream_origin(world, r),
                                     stream_direction(world, r), distance TIME(world->time[r])));
    turns->entry[r] = distance;
    turns->instance[r] = instance;
    turns->stack[r][turns->size[r]++] = STACK_LEAVE_INSTANCE;
    return make_due(due, turns, r, stack_entry(distance, bvh.instances[instance].root));
}
#endif

// The closest hits of the rays in `bits`; those of the others are left as they are. On entry
// `hits` are clear.
OUTLINED void bvh_closest_interleaved(BVH_SCALARS, StreamRays* world, const float* t_min,
                                      StreamHits* hits, uint bits) {
    const BvhView bvh = BVH_FROM_SCALARS;
    prepare_stream(world, 1);
    const uint live = bits & finite_stream(world, 1);
    Interleaved turns;
    NodesMet met;
#if ONDE_INSTANCES
    const StreamRays* rays = &turns.placed;
    const float* entry = turns.entry;
    turns.placed = *world;
    *(real16*)turns.entry = vload16(0, t_min);
    *(natural16*)turns.instance = (natural16)(BVH_NONE);
#else
    const StreamRays* rays = world;
    const float* entry = t_min;
#endif
    Due due = {0, 0};
    for (uint rest = live; rest; rest &= rest - 1) {
        const uint r = lowest_bit(rest);
        turns.size[r] = 0;
        due = make_due(due, &turns, r, stack_entry(t_min[r], bvh.root));
    }
    while (due.nodes | due.leaves) {
        Due next = {0, 0};
        uint done = due.leaves; // rays that go on with what waits on their stacks
        meet_nodes(&met, bvh, &turns, rays, entry, hits->t, due.nodes);
        for (uint rest = due.leaves; rest; rest &= rest - 1) {
            const uint r = lowest_bit(rest), word = turns.word[r];
#if ONDE_INSTANCES
            if ((word & BVH_KIND_MASK) == BVH_LEAF_INSTANCE) {
                next = enter_instance(next, &turns, bvh, world, r);
                done ^= 1u << r;
                continue;
            }
            const uint instance = turns.instance[r];
#else
            const uint instance = BVH_NONE;
#endif
            meet_leaf(bvh, word, rays, t_min, turns.distance, instance, hits, 1u << r);
        }
        for (uint rest = due.nodes; rest; rest &= rest - 1) {
            const uint r = lowest_bit(rest);
            if (met.bits[r])
                next = descend(next, &turns, bvh, &met, r);
            else
                done |= 1u << r;
        }
        for (; done; done &= done - 1) {
            const uint r = lowest_bit(done);
            next = take_waiting(next, &turns, bvh, world, t_min, r, hits->t[r]);
        }
        due = next;
    }
}

#endif
