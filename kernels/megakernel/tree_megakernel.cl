// The ray tree of a path depth first, with an explicit stack of one frame per level: the same
// estimator and the same sums as the wavefront, in memory that does not grow with the tree.
// `count` is the number of paths.
#include "chapter/whitted/parameters.h"
#include "film/film.h"
#include "film/tally.h"

// The words of a frame.
#define FRAME_ORIGIN 0
#define FRAME_DIRECTION 3
#define FRAME_FACTOR 6
#define FRAME_PRODUCT 9
#define FRAME_KIND 10
#define FRAME_HIT 11 // t, u, v, primitive, instance
#define FRAME_PASSED 16
#define FRAME_NEXT_CHILD 17
#define FRAME_WORDS 18

// By word, level and lane.
typedef struct {
    float words[FRAME_WORDS][ONDE_TREE_DEPTH][ONDE_WIDTH];
    float color[3][ONDE_TREE_DEPTH][ONDE_WIDTH];
} TreeStack;

INLINE real load_frame(float (*field)[ONDE_WIDTH], natural level) {
    float value[ONDE_WIDTH], index[ONDE_WIDTH];
    spill_real(index, as_real(level));
    for (uint k = 0; k < ONDE_WIDTH; k++) value[k] = field[as_uint(index[k])][k];
    return unspill_real(value);
}
INLINE void store_frame(float (*field)[ONDE_WIDTH], natural level, real a, uint bits) {
    float value[ONDE_WIDTH], index[ONDE_WIDTH];
    spill_real(index, as_real(level));
    spill_real(value, a);
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        field[as_uint(index[k])][k] = value[k];
    }
}
INLINE real3 load_frame3(float (*field)[ONDE_TREE_DEPTH][ONDE_WIDTH], natural level) {
    return make3(load_frame(field[0], level), load_frame(field[1], level),
                 load_frame(field[2], level));
}
INLINE void store_frame3(float (*field)[ONDE_TREE_DEPTH][ONDE_WIDTH], natural level, real3 a,
                         uint bits) {
    store_frame(field[0], level, a.x, bits);
    store_frame(field[1], level, a.y, bits);
    store_frame(field[2], level, a.z, bits);
}

INLINE void store_node(TreeStack* stack, natural level, TreeRay ray, Hits hit, uint bits) {
    store_frame3(stack->words + FRAME_ORIGIN, level, ray.origin, bits);
    store_frame3(stack->words + FRAME_DIRECTION, level, ray.direction, bits);
    store_frame3(stack->words + FRAME_FACTOR, level, ray.factor, bits);
    store_frame(stack->words[FRAME_PRODUCT], level, ray.product, bits);
    store_frame(stack->words[FRAME_PASSED], level, ray.passed, bits);
    store_frame(stack->words[FRAME_KIND], level, as_real(ray.kind), bits);
    store_frame(stack->words[FRAME_HIT], level, hit.t, bits);
    store_frame(stack->words[FRAME_HIT + 1], level, hit.u, bits);
    store_frame(stack->words[FRAME_HIT + 2], level, hit.v, bits);
    store_frame(stack->words[FRAME_HIT + 3], level, as_real(hit.primitive), bits);
    store_frame(stack->words[FRAME_HIT + 4], level, as_real(hit.instance), bits);
    store_frame(stack->words[FRAME_NEXT_CHILD], level, (real)(0.0f), bits);
}
INLINE TreeRay load_node_ray(TreeStack* stack, natural level) {
    TreeRay ray;
    ray.origin = load_frame3(stack->words + FRAME_ORIGIN, level);
    ray.direction = load_frame3(stack->words + FRAME_DIRECTION, level);
    ray.factor = load_frame3(stack->words + FRAME_FACTOR, level);
    ray.product = load_frame(stack->words[FRAME_PRODUCT], level);
    ray.passed = load_frame(stack->words[FRAME_PASSED], level);
    ray.kind = as_natural(load_frame(stack->words[FRAME_KIND], level));
    return ray;
}
INLINE Hits load_node_hit(TreeStack* stack, natural level) {
    Hits hit;
    hit.t = load_frame(stack->words[FRAME_HIT], level);
    hit.u = load_frame(stack->words[FRAME_HIT + 1], level);
    hit.v = load_frame(stack->words[FRAME_HIT + 2], level);
    hit.primitive = as_natural(load_frame(stack->words[FRAME_HIT + 3], level));
    hit.instance = as_natural(load_frame(stack->words[FRAME_HIT + 4], level));
    return hit;
}

// Traces the rays that have just been started and puts their nodes on the stack.
INLINE void enter_nodes(SceneView view, WhittedView w, __global uint* counters, TreeStack* stack,
                        natural level, TreeRay ray, natural sample, mask entering) {
    const uint bits = mask_bits(entering);
    const Hits hit = trace_closest(view.bvh, ray.origin, ray.direction, bits);
    const TreeVertex v = tree_vertex(view, w, ray, hit, entering);
    natural rays = (natural)(0u);
    const real3 color = tree_color(view, w, v, sample, entering, &rays);
    store_node(stack, level, ray, hit, bits);
    store_frame3(stack->color, level, color, bits);
    float at[ONDE_WIDTH], shadow_rays[ONDE_WIDTH];
    spill_real(at, as_real(level));
    spill_real(shadow_rays, as_real(rays));
    for (uint rest = bits; rest; rest &= rest - 1) {
        const uint k = lowest_bit(rest);
        count_rays(counters, COUNTER_EXTENSION, as_uint(at[k]), 1);
        count_rays(counters, COUNTER_SHADOW, as_uint(at[k]), as_uint(shadow_rays[k]));
    }
}

// The next child of the node on top; children that do not exist are passed over one by one.
INLINE TreeChild next_child(WhittedView w, TreeVertex v, natural kind, natural next, mask lanes) {
    TreeChild child;
    child.exists = lanes & !lanes;
    child.ray.origin = child.ray.direction = child.ray.factor = zero3();
    child.ray.product = child.ray.passed = (real)(0.0f);
    child.ray.kind = kind;
    for (uint i = 0; i < most_children(w); i++) {
        const mask turn = lanes & (next == i);
        if (!mask_bits(turn)) continue;
        const TreeChild c = tree_child(w, v, kind, i);
        child.exists = child.exists | (turn & c.exists);
        child.ray.origin = choose(turn, c.ray.origin, child.ray.origin);
        child.ray.direction = choose(turn, c.ray.direction, child.ray.direction);
        child.ray.factor = choose(turn, c.ray.factor, child.ray.factor);
        child.ray.product = choose(turn, c.ray.product, child.ray.product);
        child.ray.passed = choose(turn, c.ray.passed, child.ray.passed);
        child.ray.kind = choose(turn, c.ray.kind, child.ray.kind);
    }
    return child;
}

// Adds finished nodes to their parents.
INLINE void leave_nodes(WhittedView w, TreeStack* stack, natural level, real3 factor,
                        mask leaving) {
    const natural parent = choose(leaving, level - 1u, level);
    const real3 light = mul3(factor, load_frame3(stack->color, level));
    const real3 sum = add_light(w, load_frame3(stack->color, parent), light);
    store_frame3(stack->color, parent, sum, mask_bits(leaving));
}

// The colours of the paths from `first`, lanes at `end` and beyond left out.
INLINE real3 trace_trees(SceneView view, WhittedView w, WaveJob job, __global uint* counters,
                         TreeStack* stack, uint first, uint end) {
    const mask lanes = group_lanes(first, end);
    const natural path = choose(lanes, lane_index() + first, (natural)(first));
    const natural sample = job_sample(job, path);
    TreeRay ray = tree_root(view.frame, job_pixel(job, path), sample);
    natural level = (natural)(0u);
    mask alive = lanes, entering = lanes;
    while (mask_bits(alive)) {
        if_any (entering) enter_nodes(view, w, counters, stack, level, ray, sample, entering);
        const TreeRay own = load_node_ray(stack, level);
        const TreeVertex v = tree_vertex(view, w, own, load_node_hit(stack, level), alive);
        const natural next = as_natural(load_frame(stack->words[FRAME_NEXT_CHILD], level));
        const mask bottom = level + 1u >= w.settings->max_depth;
        const mask done = alive & (bottom | (next >= most_children(w)));
        const mask trying = alive & !done;
        const TreeChild child = next_child(w, v, own.kind, next, trying);
        store_frame(stack->words[FRAME_NEXT_CHILD], level, as_real(next + 1u), mask_bits(trying));

        const mask leaving = done & (level != 0u);
        if_any (leaving) leave_nodes(w, stack, level, arrival_factor(w, own, v), leaving);
        alive = alive & !(done & (level == 0u));
        entering = trying & child.exists;
        ray = child.ray;
        level = choose(leaving, level - 1u, choose(entering, level + 1u, level));
    }
    return load_frame3(stack->color, (natural)(0u));
}

__kernel void tree_megakernel(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, TREE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    SCENE_VIEW(view);
    WHITTED_VIEW(w);
    WAVE_JOB(job);
    FILM_VIEW(film);
    TreeStack stack;
    const uint first = unfinished[get_global_id(0)];
    for (uint i = first; i < range.end; i += ONDE_WIDTH) {
        float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH];
        const real3 color = trace_trees(view, w, job, counters, &stack, i, range.end);
        spill_real(x, color.x);
        spill_real(y, color.y);
        spill_real(z, color.z);
        for (uint k = 0; k < ONDE_WIDTH && i + k < range.end; k++)
            film_add(film, job, i + k, (float4)(x[k], y[k], z[k], 0.0f));
    }
    unfinished[get_global_id(0)] = range.end;
}
