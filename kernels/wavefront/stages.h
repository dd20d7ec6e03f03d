// The stages of a wave, each over a range [begin, end) of slots. They know lanes and slots, but not
// who launches them: the kernels around them are in staged.cl and fused.cl.
#ifndef ONDE_WAVEFRONT_STAGES_H
#define ONDE_WAVEFRONT_STAGES_H

#include "film/film.h"
#include "lib/trace.h"
#include "wavefront/state.h"

INLINE void stage_generate(SceneView view, WaveView wave, WaveJob job, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const natural id = lane_index() + i;
        const natural safe = choose(group_lanes(i, end), id, (natural)(begin));
        const natural pixel = job_pixel(job, safe);
        const Sampler sampler = sampler_start(pixel, job_sample(job, safe), view.frame->seed);
        store_path(wave, i, path_start(view.frame, pixel, sampler));
        store_path_id(wave, i, id);
    }
    for (uint i = begin; i < end; i++) wave.radiance[i] = (float4)(0.0f);
}

INLINE void stage_intersect(SceneView view, WaveView wave, uint bounce, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const real3 origin = load3(wave.state, wave.stride, LANE_ORIGIN, i);
        const real3 direction = load3(wave.state, wave.stride, LANE_DIRECTION, i);
        const uint bits = mask_bits(group_lanes(i, end));
        store_hits(wave, i, trace_bounce(view.bvh, origin, direction, bounce, bits));
    }
}

// Returns how many shadow rays there are to test.
INLINE uint stage_shade(SceneView view, WaveView wave, WaveJob job, uint bounce, uint begin,
                        uint end) {
    uint shadow_rays = 0;
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        const natural id = choose(lanes, load_path_id(wave, i), (natural)(0u));
        const Sampler sampler =
            sampler_start(job_pixel(job, id), job_sample(job, id), view.frame->seed);
        const PathVertex vertex =
            path_vertex(view, load_path(wave, i), load_hits(wave, i), sampler, bounce, lanes);
        add_radiance(wave, id, vertex.emitted, mask_bits(lanes & nonzero3(vertex.emitted)));
        store_shadow_ray(wave, i, vertex.shadow);
        store_path(wave, i, vertex.next);
        store_alive(wave, i, vertex.alive);
        shadow_rays += popcount(mask_bits(lanes & (vertex.shadow.distance > 0.0f)));
    }
    return shadow_rays;
}

INLINE void stage_shadow(SceneView view, WaveView wave, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const ShadowRay ray = load_shadow_ray(wave, i);
        const uint bits = mask_bits(group_lanes(i, end) & (ray.distance > 0.0f));
        if (!bits) continue;
        const uint blocked =
            trace_occluded(view.bvh, ray.origin, ray.direction, ray.distance, bits);
        add_radiance(wave, load_path_id(wave, i), ray.radiance, bits & ~blocked);
    }
}

// How many paths of the range go on.
INLINE uint count_alive(WaveView wave, uint begin, uint end) {
    uint count = 0;
    for (uint i = begin; i < end; i += ONDE_WIDTH)
        count += popcount(mask_bits(group_lanes(i, end) & load_alive(wave, i)));
    return count;
}

// Moves the paths that go on to consecutive slots of `to` from `first`; returns their number. In
// place it is safe for first <= begin: the write position never passes the read position.
INLINE uint stage_extend(WaveView from, WaveView to, uint begin, uint end, uint first) {
    uint next = first;
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const uint bits = mask_bits(group_lanes(i, end) & load_alive(from, i));
        move_paths(from, i, to, next, bits);
        next += popcount(bits);
    }
    return next - first;
}

// Adds the wave's radiance to the film, path by path.
INLINE void stage_accumulate(WaveView wave, WaveJob job, FilmView film, uint begin, uint end) {
    for (uint i = begin; i < end; i++) film_add(film, job, i, wave.radiance[i]);
}

#endif
