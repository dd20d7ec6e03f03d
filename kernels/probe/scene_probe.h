// Probes that read the scene.
#ifndef ONDE_PROBE_SCENE_PROBE_H
#define ONDE_PROBE_SCENE_PROBE_H

#include "probe/probe.h"
#include "shade/scene_view.h"

// PROBE with the scene as `view`.
#define SCENE_PROBE(name)                                                                          \
    INLINE void name##_of(SceneView view, Items items);                                            \
    __kernel void probe_##name(uint count, SCENE_PARAMETERS, __global const float* in,             \
                               __global float* out) {                                              \
        const uint first = get_global_id(0) * PROBE_ITEMS;                                         \
        if (first >= count) return;                                                                \
        SCENE_VIEW(view);                                                                          \
        for (uint i = first; i < first + PROBE_ITEMS; i += ONDE_WIDTH)                             \
            name##_of(view, probe_items(count, in, out, i));                                       \
    }                                                                                              \
    INLINE void name##_of(SceneView view, Items items)

#endif
