// The stages of a wave, each over a range [begin, end) of slots. They know lanes and slots, but not
// who launches them: the kernels around them are in staged.cl and fused.cl.
#ifndef ONDE_WAVEFRONT_STAGES_H
#define ONDE_WAVEFRONT_STAGES_H

#include "film/film.h"
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
    trace_rows(view.bvh, path_ray_rows(wave), path_hit_rows(wave), bounce, begin, end);
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
            path_vertex(view, load_path(wave, i), load_hit_rows(path_hit_rows(wave), i), sampler,
                        bounce, lanes);
        add_radiance(wave, id, vertex.emitted, mask_bits(lanes & nonzero3(vertex.emitted)));
        store_shadow_ray(wave, i, vertex.shadow);
        store_path(wave, i, vertex.next);
        store_alive(wave, i, vertex.alive);
        shadow_rays += popcount(mask_bits(lanes & (vertex.shadow.distance > 0.0f)));
    }
    return shadow_rays;
}

// The shadow rays of the group at slot i.
INLINE uint shadow_bits(WaveView wave, uint i, uint end) {
    const real distance = load_real(lane(wave.shadow, wave.stride, LANE_SHADOW_DISTANCE, i));
    return mask_bits(group_lanes(i, end) & (distance > 0.0f));
}

#if ONDE_STREAMS

// Slots whose shadow rays walk in company.
typedef struct {
    uint slots[OCCLUDED_WIDTH];
    uint count;
} ShadowGroup;

INLINE void light_slot(WaveView wave, uint i) {
    const uint path = as_uint(*lane(wave.state, wave.stride, LANE_ID, i));
    __global const float* light = lane(wave.shadow, wave.stride, LANE_SHADOW_RADIANCE, i);
    wave.radiance[path] +=
        (float4)(light[0], light[wave.stride], light[2 * (size_t)wave.stride], 0.0f);
}

INLINE void test_shadows(SceneView view, WaveView wave, ShadowGroup* group) {
    const float t_min[OCCLUDED_WIDTH] = {0.0f};
    float distance[OCCLUDED_WIDTH];
    StreamRays rays;
    for (uint r = 0; r < group->count; r++) {
        load_ray(&rays, r, shadow_ray_rows(wave), group->slots[r]);
        distance[r] = *lane(wave.shadow, wave.stride, LANE_SHADOW_DISTANCE, group->slots[r]);
    }
    const uint bits = 0xffffffffu >> (OCCLUDED_WIDTH - group->count);
    const uint blocked =
        bvh_occluded_stream(BVH_TO_SCALARS(view.bvh), &rays, t_min, distance, bits);
    for (uint open = bits & ~blocked; open; open &= open - 1)
        light_slot(wave, group->slots[lowest_bit(open)]);
    group->count = 0;
}

INLINE void stage_shadow(SceneView view, WaveView wave, uint begin, uint end) {
    ShadowGroup group;
    group.count = 0;
    for (uint i = begin; i < end; i += ONDE_WIDTH)
        for (uint bits = shadow_bits(wave, i, end); bits; bits &= bits - 1) {
            group.slots[group.count++] = i + lowest_bit(bits);
            if (group.count == OCCLUDED_WIDTH) test_shadows(view, wave, &group);
        }
    if (group.count > 0) test_shadows(view, wave, &group);
}

#else

INLINE void stage_shadow(SceneView view, WaveView wave, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const uint bits = shadow_bits(wave, i, end);
        if (!bits) continue;
        const ShadowRay ray = load_shadow_ray(wave, i);
        const uint blocked =
            trace_occluded(view.bvh, ray.origin, ray.direction, ray.distance, bits);
        add_radiance(wave, load_path_id(wave, i), ray.radiance, bits & ~blocked);
    }
}

#endif

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
