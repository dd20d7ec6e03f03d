// The ray trees of a chunk of paths in one work item, all levels in its arena. When they do not
// fit, the item cuts its chunk into smaller ones; a single tree that does not fit is left to the
// megakernel (`unfinished`). `count` is the number of paths of the wave.
#include "film/tally.h"
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
        levels->shadow[level] = 0;
        tree_intersect(view, a, level, begin, stop);
        const uint next = tree_shade(view, w, job, a, level, begin, stop, &levels->shadow[level]);
        if (next == TREE_OVERFLOW) return false;
        begin = whole_groups(stop);
        stop = next;
    }
    return true;
}

INLINE void fold_trees(WhittedView w, NodeArena a, __global uint* counters,
                       const TreeLevels* levels) {
    for (uint level = levels->count; level-- > 0;) {
        const uint begin = levels->begin[level], end = levels->end[level];
        if (level > 0) tree_resolve(w, a, begin, end);
        count_rays(counters, COUNTER_EXTENSION, level, end - begin);
        count_rays(counters, COUNTER_SHADOW, level, levels->shadow[level]);
    }
}

__kernel void tree_fused(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, TREE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    SCENE_VIEW(view);
    WHITTED_VIEW(w);
    NODE_ARENA(arena);
    WAVE_JOB(job);
    FILM_VIEW(film);
    TreeLevels trees;
    uint first = unfinished[get_global_id(0)];
    uint batch = range.end - range.begin;
    while (first < range.end && batch > 0) {
        const uint end = min(first + batch, range.end);
        if (grow_trees(view, w, job, arena, first, end, &trees)) {
            fold_trees(w, arena, counters, &trees);
            tree_accumulate(arena, job, film, first, end);
            first = end;
        } else {
            batch = (end - first) / 2;
        }
    }
    unfinished[get_global_id(0)] = first;
}
