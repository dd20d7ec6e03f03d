// What happens to paths between surfaces: light that a medium scatters.
#ifndef ONDE_PATH_SCATTER_H
#define ONDE_PATH_SCATTER_H

#include "path/state.h"
#include "shade/light.h"
#include "shade/media.h"

#if ONDE_MEDIA
// The paths in `lanes`, which are scattered on their way: at a distance along it.
INLINE void path_scatter(SceneView view, Path path, real at, Sampler sampler, uint bounce,
                         mask lanes, PathVertex* result) {
    if (!mask_bits(lanes)) return;
    const real3 position = madd3(path.direction, at, path.origin);
    const natural medium = medium_within(path.media);
    const real anisotropy = RECORD(view.media, medium, MediumRecord, anisotropy);
    #if ONDE_AOVS
    const real3 color = guide_color(path.throughput);
    result->aovs.alpha = choose(lanes, splat3((real)(1.0f)), result->aovs.alpha);
    #endif
    #if ONDE_TRAIL
    const mask guided = lanes & (path.mirrored != 0u);
    result->aovs.denoise_albedo = choose(guided, color, result->aovs.denoise_albedo);
    result->guided = result->guided | guided;
    #endif
    if (bounce + 1 >= view.frame->max_depth) return;
    const real2 choice = sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_CHOICE));
    if (view.frame->light_count > 0) {
        const real2 u = sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_LIGHT));
        const LightSample light =
            light_sample(view, receiver_at(position, zero3()), choice.x, u, lanes);
        const real phase = phase_value(dot3(light.direction, path.direction), anisotropy);
        const real weight =
            choose(light.delta, (real)(1.0f), power_heuristic(light.pdf, phase)) / light.pdf;
        Connection ray = no_connection();
        ray.value = mul3(path.throughput, scale3(light.radiance, weight * phase));
        const mask useful = lanes & light.valid & nonzero3(light.radiance);
        ray.origin = position;
        ray.direction = light.direction;
        const mask finite = light.distance < INFINITE_DISTANCE;
        ray.distance = choose(finite, light.distance * SHADOW_SHORTENING, light.distance);
        ray.distance = choose(useful, ray.distance, (real)(0.0f));
        ray.target = light.group;
        ray.way = choose(light.delta, (natural)(WAY_UNBENT), (natural)(0u)) | path.media;
    #if ONDE_TRAIL
        ray.diffuse = bounce == 0 ? splat3((real)(1.0f)) : path.diffuse;
        ray.transmitted = bounce == 0 ? (real)(0.0f) : path.transmitted;
    #endif
        result->connection = choose(lanes, ray, result->connection);
    }
    Path next = path;
    next.origin = position;
    next.direction =
        phase_sample(path.direction, anisotropy,
                     sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_DIRECTION)));
    next.pdf = phase_value(dot3(next.direction, path.direction), anisotropy);
    #if ONDE_LIGHT_TREE
    next.normal = zero3();
    #endif
    #if ONDE_PANES
    next.passed = (real)(0.0f);
    #endif
    #if ONDE_TRAIL
    next.mirrored = (natural)(0u);
    if (bounce == 0) {
        next.diffuse = splat3((real)(1.0f));
        next.transmitted = (real)(0.0f);
    }
    #endif
    mask alive = lanes & nonzero3(next.throughput);
    if (bounce >= view.frame->roulette_start) alive = path_roulette(&next, sampler, bounce, alive);
    result->alive = result->alive | alive;
    result->next = choose(lanes, next, result->next);
}
#endif

#endif
