// Light paths, all bounces of a chunk in one work item: a wavefront that lives in the cache. After
// each bounce the paths that go on are packed together. `count` is the number of paths of the wave.
#include "film/resolve.h"
#include "film/splat.h"
#include "film/tally.h"
#include "trace/trace.h"
#include "wavefront/light_state.h"

// What the paths of a work item have to say about themselves.
typedef struct {
    uint contributed, unblocked;
} LightCounts;

typedef struct {
    SceneView view;
    __global const LightTracingRecord* setup;
    WaveJob job;
    FilmView film;
    SplatView splats;
    LightState state;
    __global uint* counters;
} LightTracer;

// Adds the connections of the lanes in `bits` to their pixels; returns the lanes that could be.
INLINE uint add_splats(LightTracer t, Connection c, natural id, uint bits) {
    float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH], pixel[ONDE_WIDTH], path[ONDE_WIDTH];
    spill_real(x, c.value.x);
    spill_real(y, c.value.y);
    spill_real(z, c.value.z);
    spill_real(pixel, as_real(c.pixel));
    spill_real(path, as_real(id));
    uint added = 0;
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits), i = as_uint(path[k]);
        if (splat_add(t.splats, as_uint(pixel[k]), (float3)(x[k], y[k], z[k])))
            added |= 1u << k;
        else
            film_reject(t.film, path_pixel(t.job, i), path_sample(t.job, i));
    }
    return added;
}

// Tests and adds the connections of a vertex; returns the lanes that contributed.
INLINE mask join_camera(LightTracer t, Connection c, uint vertex, natural id, mask lanes,
                        LightCounts* counts) {
    const uint tested = mask_bits(lanes & (c.distance > 0.0f));
    if (!tested) return lanes & !lanes;
    count_rays(t.counters, COUNTER_SHADOW, vertex, popcount(tested));
    const uint open =
        tested & ~trace_occluded(t.view.bvh, c.origin, c.direction, c.distance, tested);
    counts->unblocked += popcount(open);
    return mask_from_bits(add_splats(t, c, id, open));
}

INLINE Sampler path_sampler(LightTracer t, natural id) {
    const natural index = (id >> t.job.log2_samples) + t.job.first_pixel;
    return light_sampler(t.view.frame, index, job_sample(t.job, id));
}

// Starts the paths of the range; returns the end of those that go on.
INLINE uint start_paths(LightTracer t, uint begin, uint end, LightCounts* counts) {
    uint next = begin;
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        LightSlots slots;
        slots.id = choose(lanes, lane_index() + i, (natural)(begin));
        slots.contributed = lanes & !lanes; // that the camera sees the light is not the ray's merit
        const LightVertex vertex = light_start(t.view, t.setup, path_sampler(t, slots.id), lanes);
        join_camera(t, vertex.connection, 0, slots.id, lanes, counts);
        slots.path = vertex.next;
        next = append_light(t.state, next, slots, mask_bits(vertex.alive));
    }
    return next;
}

// One bounce of the paths in slots begin to end; returns the end of those that go on. In place it
// is safe: the write position never passes the read position.
INLINE uint bounce_paths(LightTracer t, uint bounce, uint begin, uint end, LightCounts* counts) {
    count_rays(t.counters, COUNTER_EXTENSION, bounce, end - begin);
    uint next = begin;
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        LightSlots slots = load_light(t.state, i);
        slots.id = choose(lanes, slots.id, (natural)(0u));
        const Hits hits =
            trace_closest(t.view.bvh, slots.path.origin, slots.path.direction, mask_bits(lanes));
        const LightVertex vertex =
            light_vertex(t.view, slots.path, hits, path_sampler(t, slots.id), bounce, lanes);
        slots.contributed = slots.contributed |
                            join_camera(t, vertex.connection, bounce + 1, slots.id, lanes, counts);
        counts->contributed += popcount(mask_bits(lanes & slots.contributed & !vertex.alive));
        slots.path = vertex.next;
        next = append_light(t.state, next, slots, mask_bits(vertex.alive));
    }
    return next;
}

__kernel void light_tracing(uint count, SCENE_PARAMETERS, JOB_PARAMETERS,
                            __global const LightTracingRecord* setup, __global uint* splats,
                            __global uint* statistics, __global float* state, uint stride) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    LightTracer t;
    SCENE_VIEW(view);
    WAVE_JOB(job);
    FILM_VIEW(film);
    t.view = view;
    t.setup = setup;
    t.job = job;
    t.film = film;
    t.splats.sums = splats;
    t.splats.statistics = statistics;
    t.splats.scale = setup->splat_scale;
    t.state.state = state;
    t.state.stride = stride;
    t.counters = counters;
    LightCounts counts;
    counts.contributed = counts.unblocked = 0;
    uint end = start_paths(t, range.begin, range.end, &counts);
    for (uint bounce = 0; range.begin < end; bounce++)
        end = bounce_paths(t, bounce, range.begin, end, &counts);
    sum_add(&statistics[2 * LIGHT_CONTRIBUTED], counts.contributed, 0);
    sum_add(&statistics[2 * LIGHT_UNBLOCKED], counts.unblocked, 0);
}
