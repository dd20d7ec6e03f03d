// The chapter's recursion as the schedulers see it: a path is a ray tree, of which one ray at a
// time is in flight. A vertex has a connection for each sample of each source; when they have been
// answered, the tree goes on with the next child, depth first. Nodes that wait for a child lie on a
// stack.
#ifndef ONDE_CHAPTER_WHITTED_ESTIMATOR_H
#define ONDE_CHAPTER_WHITTED_ESTIMATOR_H

#include "chapter/whitted/node_stack.h"
#include "chapter/whitted/shadow.h"
#include "film/job.h"

#define ESTIMATOR_TREE 1
#define ESTIMATOR_EMITS 0
#define ESTIMATOR_TRANSLUCENT (ONDE_TRANSLUCENT || ONDE_ALPHA)
#define ESTIMATOR_CONNECTS_START 0
#define ESTIMATOR_SPLATS 0
#define ESTIMATOR_UNBENT 0
#define ESTIMATOR_COLUMNS WHITTED_COLUMNS
#define ESTIMATOR_CONNECTIONS CONNECTION_COLUMNS

typedef WhittedRay State;
typedef WhittedVertex TreeVertex;
typedef struct {
    Connection connection;
    State next;
    mask alive;
} Step;

// nodes: RAY_TREE words for each path of a wave and each level; node_stride: between two words.
#define ESTIMATOR_PARAMETERS                                                                       \
    , __global const WhittedRecord *whitted, __global const PhongRecord *phong,                    \
        __global const SourceRecord *sources, __global float *nodes, uint node_stride,             \
        uint node_paths

typedef struct {
    SceneView view;
    WaveJob job;
    WhittedView w;
    NodeStack stack;
} Estimator;
#define ESTIMATOR(e)                                                                               \
    SCENE_VIEW(scene_view);                                                                        \
    WAVE_JOB(wave_job);                                                                            \
    const WhittedView whitted_view = {whitted, phong, sources};                                    \
    const NodeStack node_stack = {nodes, node_stride, node_paths};                                 \
    const Estimator e = {scene_view, wave_job, whitted_view, node_stack}

// A sample of a source.
typedef struct {
    __global const SourceRecord* source;
    uint sample;
} SourcePlace;

INLINE uint samples_of(__global const SourceRecord* source) {
    return source->samples * source->samples;
}

// Of connection k, below estimator_connections().
INLINE SourcePlace source_place(WhittedView w, uint k) {
    SourcePlace place = {w.sources, k};
    while (place.sample >= samples_of(place.source)) {
        place.sample -= samples_of(place.source);
        place.source++;
    }
    return place;
}

INLINE uint estimator_connections(Estimator e) {
    uint count = 0;
    for (uint i = 0; i < e.w.settings->source_count; i++) count += samples_of(e.w.sources + i);
    return count;
}

INLINE State estimator_start(Estimator e, natural id) {
    return whitted_root(e.view.frame, job_pixel(e.job, id), job_sample(e.job, id));
}

// How many connections from the k-th on are samples of its source.
INLINE uint estimator_same_source(Estimator e, uint k) {
    const SourcePlace place = source_place(e.w, k);
    return samples_of(place.source) - place.sample;
}

// What the rays of `lanes` see at their hits. All functions below of a ray and its vertex take
// both.
INLINE TreeVertex estimator_look(Estimator e, State ray, Hits hits, mask lanes) {
    return whitted_vertex(e.view, e.w, ray, hits, lanes);
}

// The colour of nodes without their sources and emission.
INLINE real3 estimator_ambient(Estimator e, TreeVertex v, State ray, mask lanes) {
    const mask missed = missed_lanes(v, lanes), lit = lit_lanes(v, lanes);
    real3 color = zero3();
    if_any (missed) color = choose(missed, whitted_background(e.view, e.w, ray.direction), color);
    if_any (lit) color = choose(lit, ambient_light(e.w, v, phong_color(e.view, e.w, v)), color);
    return color;
}

// Adds a source whose samples have all been answered to the colour of the nodes.
INLINE real3 add_source(Estimator e, TreeVertex v, __global const SourceRecord* source, real sum,
                        real3 color, mask lanes) {
    const real3 light = mul3(phong_color(e.view, e.w, v), source_light(source, sum));
    return choose(lit_lanes(v, lanes), add_light(e.w, color, light), color);
}

// Connection k of nodes whose colour so far is in `ray`; `sum` is that of the answers of its source
// so far.
INLINE Connection estimator_connection(Estimator e, TreeVertex v, State* ray, natural id, uint k,
                                       real* sum, mask lanes) {
    const mask lit = lit_lanes(v, lanes);
    if (!mask_bits(lit)) return no_connection();
    const SourcePlace place = source_place(e.w, k);
    if (place.sample == 0 && k > 0) {
        ray->color = add_source(e, v, place.source - 1, *sum, ray->color, lanes);
        *sum = choose(lanes, (real)(0.0f), *sum);
    }
    const real2 offset = sample_offset(job_sample(e.job, id));
    return sample_connection(e.w, v, place.source, grid_point(place.source, place.sample, offset),
                             lit);
}

// The first stage of nodes, where each stage is on its own.
OUTLINED Step estimator_vertex(Estimator e, State ray, Hits hits, natural id, uint bounce,
                               mask lanes) {
    const TreeVertex v = estimator_look(e, ray, hits, lanes);
    real sum = (real)(0.0f);
    Step step;
    step.alive = lanes;
    step.next = ray;
    step.next.color = estimator_ambient(e, v, ray, lanes);
    step.connection = no_connection();
    if (e.w.settings->source_count > 0)
        step.connection = estimator_connection(e, v, &step.next, id, 0, &sum, lanes);
    return step;
}

#if ESTIMATOR_TRANSLUCENT
INLINE real3 estimator_transmittance(Estimator e, real3 origin, real3 direction, real distance,
                                     natural way, natural id, uint bounce, mask lanes) {
    SpilledRays rays;
    spill_rays(&rays, origin, direction);
    float end[ONDE_WIDTH], through[ONDE_WIDTH];
    spill_real(end, distance);
    spill_real(through, (real)(0.0f));
    for (uint bits = mask_bits(lanes); bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        through[k] = source_transmittance(e.view, e.w.phong, spilled_origin(&rays, k),
                                          spilled_direction(&rays, k), end[k]);
    }
    return splat3(unspill_real(through));
}
#endif

#if ONDE_SEEN_THROUGH
INLINE mask estimator_culls(State ray, mask lanes) {
    return lanes;
}

// A ray of a tree is known by its place and direction: what it passes is drawn by a hash of them.
INLINE Hits estimator_pass(Estimator e, State ray, Hits hits, natural id, uint bounce, mask lanes) {
    natural key = job_pixel(e.job, id) + hash_natural(job_sample(e.job, id));
    key = hash_natural(key ^ as_natural(ray.direction.x)) ^ as_natural(ray.direction.y);
    key = hash_natural(key ^ as_natural(ray.direction.z)) ^ as_natural(ray.origin.x);
    key = hash_natural(key ^ as_natural(ray.origin.y)) ^ as_natural(ray.origin.z);
    const real u = unit_real(hash_natural(key));
    return pass_surfaces(e.view, ray.origin, ray.direction, hits, u, lanes, lanes);
}
#endif

// The next child of nodes; children that do not exist are passed over one by one.
INLINE WhittedChild next_child(WhittedView w, WhittedVertex v, Node node, mask lanes) {
    WhittedChild child;
    child.exists = lanes & !lanes;
    child.ray = node.ray;
    for (uint i = 0; i < most_children(w); i++) {
        const mask its_turn = lanes & (node.next_child == i);
        if (!mask_bits(its_turn)) continue;
        const WhittedChild c = whitted_child(w, v, node.ray.kind, i);
        child.exists = child.exists | (its_turn & c.exists);
        child.ray = choose(its_turn, c.ray, child.ray);
    }
    return child;
}

// The colour of nodes that have been answered: the last source, and emission.
INLINE real3 estimator_color(Estimator e, TreeVertex v, State ray, real sum, mask lanes) {
    const mask lit = lit_lanes(v, lanes);
    if (!mask_bits(lit)) return ray.color;
    real3 color = ray.color;
    const uint sources = e.w.settings->source_count;
    if (sources > 0) color = add_source(e, v, e.w.sources + sources - 1, sum, color, lanes);
    return choose(lit, add_light(e.w, surface_emission(e.view, v, lit), color), color);
}

// From nodes whose own colour is known to the next ray of their trees: a child of theirs, or of a
// node that waits for them. Returns the lanes whose trees go on; the others' are done, and `ray`
// holds the colour of the root.
OUTLINED mask estimator_advance(Estimator e, TreeVertex v, State* ray, Hits hits, natural id,
                                mask lanes) {
    Node node;
    node.ray = *ray;
    node.hits = hits;
    node.next_child = (natural)(0u);
    mask searching = lanes, alive = lanes & !lanes;
    while (mask_bits(searching)) {
        const mask bottom = node.ray.level + 1u >= e.w.settings->max_depth;
        const mask done = searching & (bottom | (node.next_child >= most_children(e.w)));
        const mask trying = searching & !done;
        const WhittedChild child = next_child(e.w, v, node, trying);
        node.next_child = choose(trying, node.next_child + 1u, node.next_child);

        const mask descending = trying & child.exists;
        if_any (descending) {
            push_node(e.stack, node, id, descending);
            *ray = choose(descending, child.ray, *ray);
            alive = alive | descending;
        }
        const mask finished = done & (node.ray.level == 0u), leaving = done & !finished;
        ray->color = choose(finished, node.ray.color, ray->color);
        searching = searching & !(descending | finished);
        if_any (leaving) {
            const real3 light = mul3(arrival_factor(e.w, node.ray, v), node.ray.color);
            Node parent = pop_node(e.stack, node.ray.level - 1u, id, leaving);
            parent.ray.color = add_light(e.w, parent.ray.color, light);
            node.ray = choose(leaving, parent.ray, node.ray);
            node.hits = choose(leaving, parent.hits, node.hits);
            node.next_child = choose(leaving, parent.next_child, node.next_child);
            v = estimator_look(e, node.ray, node.hits, searching);
        }
    }
    return alive;
}

#endif
