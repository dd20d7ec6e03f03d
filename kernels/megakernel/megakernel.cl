// The whole path in one loop, its state in registers. The same estimator, sample by sample, as the
// wavefront; `count` is the number of paths.
#include "film/film.h"
#include "film/tally.h"
#include "path/path.h"
#include "trace/trace.h"

// The radiance of the paths from `first`, lanes at `end` and beyond left out.
INLINE real3 trace_paths(SceneView view, WaveJob job, __global uint* counters, uint first,
                         uint end) {
    const mask lanes = group_lanes(first, end);
    const natural id = choose(lanes, lane_index() + first, (natural)(first));
    const natural pixel = job_pixel(job, id);
    const Sampler sampler = sampler_start(pixel, job_sample(job, id), view.frame->seed);
    Path path = path_start(view.frame, pixel, sampler);
    real3 radiance = zero3();
    mask alive = lanes;
    for (uint bounce = 0; mask_bits(alive); bounce++) {
        const uint bits = mask_bits(alive);
        count_rays(counters, COUNTER_EXTENSION, bounce, popcount(bits));
        const Hits hits = trace_bounce(view.bvh, path.origin, path.direction, bounce, bits);
        const PathVertex vertex = path_vertex(view, path, hits, sampler, bounce, alive);
        radiance = choose(alive, add3(radiance, vertex.emitted), radiance);
        const ShadowRay ray = vertex.shadow;
        const uint tested = mask_bits(alive & (ray.distance > 0.0f));
        count_rays(counters, COUNTER_SHADOW, bounce, popcount(tested));
        const uint open =
            tested & ~trace_occluded(view.bvh, ray.origin, ray.direction, ray.distance, tested);
        const mask lit = mask_from_bits(open);
        radiance = choose(lit, add3(radiance, ray.radiance), radiance);
        path = vertex.next;
        alive = vertex.alive;
    }
    return radiance;
}

__kernel void megakernel(uint count, SCENE_PARAMETERS, JOB_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    SCENE_VIEW(view);
    WAVE_JOB(job);
    FILM_VIEW(film);
    for (uint i = range.begin; i < range.end; i += ONDE_WIDTH) {
        float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH];
        const real3 sum = trace_paths(view, job, counters, i, range.end);
        spill_real(x, sum.x);
        spill_real(y, sum.y);
        spill_real(z, sum.z);
        for (uint k = 0; k < ONDE_WIDTH && i + k < range.end; k++)
            film_add(film, job, i + k, (float4)(x[k], y[k], z[k], 0.0f));
    }
}
