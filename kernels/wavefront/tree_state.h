// The ray tree of the Whitted estimator in memory: lanes of one word per node. A work item owns an
// arena of nodes, in which its chunk's trees lie level by level; a level begins at a multiple of
// ONDE_WIDTH, so that whole groups may be stored without touching the next one.
//
// Bytes per node: 22 lanes (88).
#ifndef ONDE_WAVEFRONT_TREE_STATE_H
#define ONDE_WAVEFRONT_TREE_STATE_H

#include "chapter/whitted/parameters.h"
#include "film/film.h"
#include "trace/trace_rows.h"

#define NODE_ORIGIN 0
#define NODE_DIRECTION 3
#define NODE_FACTOR 6
#define NODE_PRODUCT 9
#define NODE_KIND 10
#define NODE_PARENT 11 // slot, in the arena
#define NODE_PATH 12   // index of the path in its wave
#define NODE_HIT 13    // t, u, v, primitive, instance
#define NODE_COLOR 18
#define NODE_PASSED 21
#define NODE_LANES 22

typedef struct {
    __global float* lanes; // of this work item: lane k of slot i is at k * stride + i
    uint stride;
    uint capacity; // slots, a multiple of ONDE_WIDTH
} NodeArena;

#define NODE_ARENA(arena)                                                                          \
    NodeArena arena;                                                                               \
    arena.lanes = nodes + get_global_id(0) * capacity;                                             \
    arena.stride = stride;                                                                         \
    arena.capacity = capacity

INLINE uint whole_groups(uint i) {
    return (i + ONDE_WIDTH - 1) / ONDE_WIDTH * ONDE_WIDTH;
}

INLINE __global float* node_lane(NodeArena a, uint k, uint i) {
    return a.lanes + (size_t)k * a.stride + i;
}
INLINE real3 load_node3(NodeArena a, uint k, uint i) {
    return make3(load_real(node_lane(a, k, i)), load_real(node_lane(a, k + 1, i)),
                 load_real(node_lane(a, k + 2, i)));
}
INLINE void store_node3(NodeArena a, uint k, uint i, real3 v) {
    store_real(node_lane(a, k, i), v.x);
    store_real(node_lane(a, k + 1, i), v.y);
    store_real(node_lane(a, k + 2, i), v.z);
}

INLINE TreeRay load_tree_ray(NodeArena a, uint i) {
    TreeRay ray;
    ray.origin = load_node3(a, NODE_ORIGIN, i);
    ray.direction = load_node3(a, NODE_DIRECTION, i);
    ray.factor = load_node3(a, NODE_FACTOR, i);
    ray.product = load_real(node_lane(a, NODE_PRODUCT, i));
    ray.passed = load_real(node_lane(a, NODE_PASSED, i));
    ray.kind = load_natural(node_lane(a, NODE_KIND, i));
    return ray;
}

INLINE void compress3(NodeArena a, uint k, uint i, real3 v, uint bits) {
    compress_real(node_lane(a, k, i), v.x, bits);
    compress_real(node_lane(a, k + 1, i), v.y, bits);
    compress_real(node_lane(a, k + 2, i), v.z, bits);
}

// Stores the rays of `bits` in consecutive slots from i.
INLINE void push_tree_rays(NodeArena a, uint i, TreeRay ray, natural parent, natural path,
                           uint bits) {
    compress3(a, NODE_ORIGIN, i, ray.origin, bits);
    compress3(a, NODE_DIRECTION, i, ray.direction, bits);
    compress3(a, NODE_FACTOR, i, ray.factor, bits);
    compress_real(node_lane(a, NODE_PRODUCT, i), ray.product, bits);
    compress_real(node_lane(a, NODE_PASSED, i), ray.passed, bits);
    compress_real(node_lane(a, NODE_KIND, i), as_real(ray.kind), bits);
    compress_real(node_lane(a, NODE_PARENT, i), as_real(parent), bits);
    compress_real(node_lane(a, NODE_PATH, i), as_real(path), bits);
}

INLINE HitRows node_hits(NodeArena a) {
    const HitRows rows = {node_lane(a, NODE_HIT, 0), a.stride};
    return rows;
}

// The colour of one node.
INLINE float4 node_color(NodeArena a, uint i) {
    return (float4)(*node_lane(a, NODE_COLOR, i), *node_lane(a, NODE_COLOR + 1, i),
                    *node_lane(a, NODE_COLOR + 2, i), 0.0f);
}

#endif
