// Whole light paths in one loop, their state in registers. `count` is the number of paths.
#include "film/resolve.h"
#include "film/splat.h"
#include "film/tally.h"
#include "lib/trace.h"
#include "light_tracing/light_tracing.h"

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
    __global uint* counters;
} LightTracer;

// Adds the connections of the lanes in `bits` to their pixels; returns the lanes that could be.
// `first` is the first path of the group.
INLINE uint add_splats(LightTracer t, Connection c, uint first, uint bits) {
    float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH], pixel[ONDE_WIDTH];
    spill_real(x, c.value.x);
    spill_real(y, c.value.y);
    spill_real(z, c.value.z);
    spill_real(pixel, as_real(c.pixel));
    uint added = 0;
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        if (splat_add(t.splats, as_uint(pixel[k]), (float3)(x[k], y[k], z[k])))
            added |= 1u << k;
        else
            film_reject(t.film, path_pixel(t.job, first + k), path_sample(t.job, first + k));
    }
    return added;
}

// Tests and adds the connections of a vertex; returns the lanes that contributed.
INLINE uint join_camera(LightTracer t, Connection c, uint vertex, uint first, uint alive,
                        LightCounts* counts) {
    const uint tested = alive & mask_bits(c.distance > 0.0f);
    if (!tested) return 0;
    count_rays(t.counters, COUNTER_SHADOW, vertex, popcount(tested));
    const uint open =
        tested & ~trace_occluded(t.view.bvh, c.origin, c.direction, c.distance, tested);
    counts->unblocked += popcount(open);
    return add_splats(t, c, first, open);
}

INLINE void trace_light(LightTracer t, uint first, uint end, LightCounts* counts) {
    const mask lanes = group_lanes(first, end);
    const natural id = choose(lanes, lane_index() + first, (natural)(first));
    const natural index = (id >> t.job.log2_samples) + t.job.first_pixel;
    const Sampler sampler = light_sampler(t.view.frame, index, job_sample(t.job, id));
    LightVertex vertex = light_start(t.view, t.setup, sampler, lanes);
    join_camera(t, vertex.connection, 0, first, mask_bits(lanes), counts); // not the ray's merit
    uint useful = 0;
    for (uint bounce = 0; mask_bits(vertex.alive); bounce++) {
        const uint alive = mask_bits(vertex.alive);
        count_rays(t.counters, COUNTER_EXTENSION, bounce, popcount(alive));
        const LightPath path = vertex.next;
        const Hits hits = trace_closest(t.view.bvh, path.origin, path.direction, alive);
        vertex = light_vertex(t.view, path, hits, sampler, bounce, vertex.alive);
        useful |= join_camera(t, vertex.connection, bounce + 1, first, alive, counts);
    }
    counts->contributed += popcount(useful);
}

__kernel void light_tracing(uint count, SCENE_PARAMETERS, JOB_PARAMETERS,
                            __global const LightTracingRecord* setup, __global uint* splats,
                            __global uint* statistics) {
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
    t.counters = counters;
    LightCounts counts;
    counts.contributed = counts.unblocked = 0;
    for (uint i = range.begin; i < range.end; i += ONDE_WIDTH)
        trace_light(t, i, range.end, &counts);
    sum_add(&statistics[2 * LIGHT_CONTRIBUTED], counts.contributed, 0);
    sum_add(&statistics[2 * LIGHT_UNBLOCKED], counts.unblocked, 0);
}
