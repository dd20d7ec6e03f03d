// What the Whitted kernels take beside scene and job, and the kernel that begins a wave.
#ifndef ONDE_CHAPTER_WHITTED_PARAMETERS_H
#define ONDE_CHAPTER_WHITTED_PARAMETERS_H

#include "chapter/whitted/tree.h"

// The levels that a tree may have.
#ifndef ONDE_TREE_DEPTH
    #define ONDE_TREE_DEPTH MAX_TREE_DEPTH
#endif

// In the order in which the host binds them.
// unfinished: per work item, the first path that is still to be done, or the end of its range.
// nodes, stride, capacity: the arenas; levels: per work item, LEVEL_WORDS for each level.
#define TREE_PARAMETERS                                                                            \
    __global const WhittedRecord *whitted, __global const PhongRecord *phong,                      \
        __global const SourceRecord *sources, __global uint *unfinished, __global float *nodes,    \
        __global uint *levels, uint stride, uint capacity, uint level

#define WHITTED_VIEW(view)                                                                         \
    WhittedView view;                                                                              \
    view.settings = whitted;                                                                       \
    view.phong = phong;                                                                            \
    view.sources = sources

// Begins a wave of `paths`, `chunk` a work item: nothing of it is done. count: the work items.
__kernel void tree_begin(uint count, __global uint* unfinished, uint chunk, uint paths) {
    const uint item = (uint)get_global_id(0);
    if (item < count) unfinished[item] = min(item * chunk, paths);
}

#endif
