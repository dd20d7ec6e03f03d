// The ray trees with one kernel per stage and level. An item whose arena is too small leaves its
// paths `unfinished`, and the host has them done in smaller pieces. `count` is the number of paths
// of the wave.
#include "film/tally.h"
#include "wavefront/tree_stages.h"

// What a work item knows of a level of its trees. After an overflow the first level is empty.
typedef struct {
    uint begin, end; // slots
    uint shadow_rays;
} TreeLevel;

INLINE __global TreeLevel* item_levels(__global uint* levels) {
    return (__global TreeLevel*)levels + get_global_id(0) * (ONDE_TREE_DEPTH + 1);
}
// Every item that has paths to do.
INLINE bool has_work(Range range, __global const uint* unfinished) {
    return range.begin < range.end && unfinished[get_global_id(0)] < range.end;
}

__kernel void tree_generate_rays(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, TREE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (!has_work(range, unfinished)) return;
    SCENE_VIEW(view);
    NODE_ARENA(arena);
    WAVE_JOB(job);
    __global TreeLevel* first = item_levels(levels);
    first->begin = first->end = 0;
    if (whole_groups(range.end - range.begin) > capacity) return;
    first->end = tree_generate(view, job, arena, range.begin, range.end);
}

__kernel void tree_intersect_rays(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, TREE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (!has_work(range, unfinished)) return;
    SCENE_VIEW(view);
    NODE_ARENA(arena);
    __global const TreeLevel* own = item_levels(levels) + level;
    tree_intersect(view, arena, level, own->begin, own->end);
}

__kernel void tree_shade_hits(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, TREE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (!has_work(range, unfinished)) return;
    SCENE_VIEW(view);
    WHITTED_VIEW(w);
    NODE_ARENA(arena);
    WAVE_JOB(job);
    __global TreeLevel* own = item_levels(levels) + level;
    uint rays = 0;
    const uint next = tree_shade(view, w, job, arena, level, own->begin, own->end, &rays);
    own->shadow_rays = rays;
    own[1].begin = whole_groups(own->end);
    own[1].end = next == TREE_OVERFLOW ? own[1].begin : next;
    if (next == TREE_OVERFLOW) item_levels(levels)->end = 0;
}

__kernel void tree_resolve_level(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, TREE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (!has_work(range, unfinished)) return;
    WHITTED_VIEW(w);
    NODE_ARENA(arena);
    __global const TreeLevel* first = item_levels(levels);
    if (first->end > 0) tree_resolve(w, arena, first[level].begin, first[level].end);
}

__kernel void tree_accumulate_paths(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, TREE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (!has_work(range, unfinished)) return;
    NODE_ARENA(arena);
    WAVE_JOB(job);
    FILM_VIEW(film);
    __global const TreeLevel* own = item_levels(levels);
    if (own->end == 0) return;
    tree_accumulate(arena, job, film, range.begin, range.end);
    for (uint l = 0; l < whitted->max_depth && own[l].begin < own[l].end; l++) {
        count_rays(counters, COUNTER_EXTENSION, l, own[l].end - own[l].begin);
        count_rays(counters, COUNTER_SHADOW, l, own[l].shadow_rays);
    }
    unfinished[get_global_id(0)] = range.end;
}
