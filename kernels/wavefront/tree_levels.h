// All levels of a few trees in one work item's arena: grown forward, folded backward.
#ifndef ONDE_WAVEFRONT_TREE_LEVELS_H
#define ONDE_WAVEFRONT_TREE_LEVELS_H

#include "wavefront/tree_stages.h"

// Where the levels of the trees lie in the arena, and their shadow rays.
typedef struct {
    uint begin[ONDE_TREE_DEPTH], end[ONDE_TREE_DEPTH], shadow[ONDE_TREE_DEPTH];
    uint count;
} TreeLevels;

// Grows the trees of paths [first, end); false when they do not fit.
INLINE bool grow_trees(SceneView view, WhittedView w, WaveJob job, NodeArena a, uint first,
                       uint end, TreeLevels* levels) {
    levels->count = 0;
    if (whole_groups(end - first) > a.capacity) return false;
    uint begin = 0, stop = tree_generate(view, job, a, first, end);
    while (begin < stop) {
        const uint level = levels->count++;
        levels->begin[level] = begin;
        levels->end[level] = stop;
        tree_intersect(view, a, level, begin, stop);
        const uint next = tree_shade(view, w, job, a, level, begin, stop, &levels->shadow[level]);
        if (next == TREE_OVERFLOW) return false;
        begin = whole_groups(stop);
        stop = next;
    }
    return true;
}

INLINE void fold_trees(WhittedView w, NodeArena a, const TreeLevels* levels) {
    for (uint level = levels->count; level-- > 1;)
        tree_resolve(w, a, levels->begin[level], levels->end[level]);
}

#endif
