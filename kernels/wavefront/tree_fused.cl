// The ray trees of a chunk of paths in one work item, all levels in its arena. When they do not
// fit, the item cuts its chunk into smaller ones; a single tree that does not fit is left to the
// megakernel (`unfinished`). `count` is the number of paths of the wave.
#include "film/tally.h"
#include "wavefront/tree_levels.h"

INLINE void count_trees(__global uint* counters, const TreeLevels* levels) {
    for (uint level = 0; level < levels->count; level++) {
        count_rays(counters, COUNTER_EXTENSION, level, levels->end[level] - levels->begin[level]);
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
            fold_trees(w, arena, &trees);
            count_trees(counters, &trees);
            tree_accumulate(arena, job, film, first, end);
            first = end;
        } else {
            batch = (end - first) / 2;
        }
    }
    unfinished[get_global_id(0)] = first;
}
