// The stages that grow ray trees level by level and fold them up again, each over slots [begin,
// end) of a work item's arena. They know lanes and slots, but not who launches them.
#ifndef ONDE_WAVEFRONT_TREE_STAGES_H
#define ONDE_WAVEFRONT_TREE_STAGES_H

#include "wavefront/tree_state.h"

#define TREE_OVERFLOW 0xffffffffu

// The camera rays of paths [first, end) in slots from 0. Returns how many.
INLINE uint tree_generate(SceneView view, WaveJob job, NodeArena a, uint first, uint end) {
    for (uint i = 0; first + i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(first + i, end);
        const natural path = choose(lanes, lane_index() + (first + i), (natural)(first));
        const TreeRay ray = tree_root(view.frame, job_pixel(job, path), job_sample(job, path));
        push_tree_rays(a, i, ray, (natural)(0u), path, mask_bits(lanes));
    }
    return end - first;
}

INLINE void tree_intersect(SceneView view, NodeArena a, uint level, uint begin, uint end) {
    const RayRows rays = {node_lane(a, NODE_ORIGIN, 0), node_lane(a, NODE_DIRECTION, 0), a.stride};
    trace_rows(view.bvh, rays, node_hits(a), level, begin, end);
}

// Stores the group's own colours and starts the children in slots from `next` on. Returns the slot
// after the last child, or TREE_OVERFLOW when they do not fit. `rays` counts the shadow rays of
// each lane.
INLINE uint tree_shade_group(SceneView view, WhittedView w, WaveJob job, NodeArena a, uint level,
                             uint i, uint end, uint next, natural* rays) {
    const mask lanes = group_lanes(i, end);
    const TreeRay ray = load_tree_ray(a, i);
    const TreeVertex v = tree_vertex(view, w, ray, load_hit_rows(node_hits(a), i), lanes);
    const natural path = choose(lanes, load_natural(node_lane(a, NODE_PATH, i)), (natural)(0u));
    store_node3(a, NODE_COLOR, i, tree_color(view, w, v, job_sample(job, path), lanes, rays));
    store_node3(a, NODE_FACTOR, i, arrival_factor(w, ray, v));
    if (level + 1 >= w.settings->max_depth) return next;
    const natural parent = lane_index() + i;
    for (uint k = 0; k < most_children(w); k++) {
        const TreeChild child = tree_child(w, v, ray.kind, k);
        const uint bits = mask_bits(lanes & child.exists);
        if (next + popcount(bits) > a.capacity) return TREE_OVERFLOW;
        push_tree_rays(a, next, child.ray, parent, path, bits);
        next += popcount(bits);
    }
    return next;
}

// Shades a level; the next one begins at whole_groups(end). Returns where that ends, or
// TREE_OVERFLOW, and in `rays` how many shadow rays there were.
INLINE uint tree_shade(SceneView view, WhittedView w, WaveJob job, NodeArena a, uint level,
                       uint begin, uint end, uint* rays) {
    uint next = whole_groups(end);
    natural lane_rays = (natural)(0u);
    for (uint i = begin; i < end && next != TREE_OVERFLOW; i += ONDE_WIDTH)
        next = tree_shade_group(view, w, job, a, level, i, end, next, &lane_rays);
    *rays = sum_natural(lane_rays);
    return next;
}

// Adds the colours of a level to those of the level above, in the order of the children.
INLINE void tree_resolve(WhittedView w, NodeArena a, uint begin, uint end) {
    for (uint i = begin; i < end; i++) {
        const uint parent = as_uint(*node_lane(a, NODE_PARENT, i));
        for (uint k = 0; k < 3; k++) {
            __global float* sum = node_lane(a, NODE_COLOR + k, parent);
            const float light =
                *node_lane(a, NODE_FACTOR + k, i) * *node_lane(a, NODE_COLOR + k, i);
            *sum = w.settings->saturate ? min_fast(*sum + light, 1.0f) : *sum + light;
        }
    }
}

INLINE void tree_accumulate(NodeArena a, WaveJob job, FilmView film, uint first, uint end) {
    for (uint i = first; i < end; i++) film_add(film, job, i, node_color(a, i - first));
}

#endif
