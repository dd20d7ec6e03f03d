// The nodes of ray trees that wait for a child: a stack of one node a level for each path.
#ifndef ONDE_CHAPTER_WHITTED_NODE_STACK_H
#define ONDE_CHAPTER_WHITTED_NODE_STACK_H

#include "chapter/whitted/whitted.h"

// A node: its ray, with the colour so far, what it met, and the child that is next.
typedef struct {
    WhittedRay ray;
    Hits hits;
    natural next_child;
} Node;

#define NODE_COLUMNS(VECTOR, REAL, NATURAL)                                                        \
    WHITTED_COLUMNS(VECTOR, REAL, NATURAL) HIT_COLUMNS(VECTOR, REAL, NATURAL) NATURAL(next_child)

// Word k of the node of a path at a level lies at k * stride + level * paths + path.
typedef struct {
    __global float* words;
    uint stride, paths;
} NodeStack;

#define GATHER_VECTOR(name)                                                                        \
    node.name = make3(gather_real(p, slot), gather_real(p + s.stride, slot),                       \
                      gather_real(p + 2 * (size_t)s.stride, slot));                                \
    p += 3 * (size_t)s.stride;
#define GATHER_REAL(name)                                                                          \
    node.name = gather_real(p, slot);                                                              \
    p += s.stride;
#define GATHER_NATURAL(name)                                                                       \
    node.name = as_natural(gather_real(p, slot));                                                  \
    p += s.stride;
#define SCATTER_VECTOR(name)                                                                       \
    scatter_real(p, slot, node.name.x, bits);                                                      \
    scatter_real(p + s.stride, slot, node.name.y, bits);                                           \
    scatter_real(p + 2 * (size_t)s.stride, slot, node.name.z, bits);                               \
    p += 3 * (size_t)s.stride;
#define SCATTER_REAL(name)                                                                         \
    scatter_real(p, slot, node.name, bits);                                                        \
    p += s.stride;
#define SCATTER_NATURAL(name)                                                                      \
    scatter_real(p, slot, as_real(node.name), bits);                                               \
    p += s.stride;

// The node that waits at a level, of the paths in `lanes`.
INLINE Node pop_node(NodeStack s, natural level, natural path, mask lanes) {
    const natural slot = choose(lanes, level, (natural)(0u)) * s.paths + path;
    __global const float* p = s.words;
    Node stacked;
    {
        WhittedRay node;
        WHITTED_COLUMNS(GATHER_VECTOR, GATHER_REAL, GATHER_NATURAL)
        stacked.ray = node;
    }
    {
        Hits node;
        HIT_COLUMNS(GATHER_VECTOR, GATHER_REAL, GATHER_NATURAL)
        stacked.hits = node;
    }
    stacked.next_child = as_natural(gather_real(p, slot));
    return stacked;
}

// Has the nodes of the paths in `lanes` wait, each at the level of its ray.
INLINE void push_node(NodeStack s, Node waiting, natural path, mask lanes) {
    const uint bits = mask_bits(lanes);
    const natural slot = choose(lanes, waiting.ray.level, (natural)(0u)) * s.paths + path;
    __global float* p = s.words;
    {
        const WhittedRay node = waiting.ray;
        WHITTED_COLUMNS(SCATTER_VECTOR, SCATTER_REAL, SCATTER_NATURAL)
    }
    {
        const Hits node = waiting.hits;
        HIT_COLUMNS(SCATTER_VECTOR, SCATTER_REAL, SCATTER_NATURAL)
    }
    scatter_real(p, slot, as_real(waiting.next_child), bits);
}

#endif
