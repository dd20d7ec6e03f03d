// What happens to paths between surfaces: light that a medium scatters.
#ifndef ONDE_PATH_SCATTER_H
#define ONDE_PATH_SCATTER_H

#include "path/state.h"
#include "shade/light.h"
#include "shade/media.h"

#if ONDE_MEDIA
    #if ONDE_GRIDS
// By channel, how likely the way is that the rate of another has drawn, over the mean by shares of
// light (spectral multiple importance sampling: Miller et al. 2019, A Null-Scattering Path Integral
// Formulation of Light Transport). Each unit of `passed` makes it exp(-extinction) times as likely,
// each collision, be there something or not, in proportion to the extinction.
INLINE real3 spectral_weight(real3 extinction, real3 share, real passed, natural collisions) {
    const real least = (real)(1e-30f), count = to_real(collisions);
    const real nepers = -1.44269504f * passed;
    const real x = fma(count, log2_real(max_real(extinction.x, least)), extinction.x * nepers);
    const real y = fma(count, log2_real(max_real(extinction.y, least)), extinction.y * nepers);
    const real z = fma(count, log2_real(max_real(extinction.z, least)), extinction.z * nepers);
    const real none = (real)(-1e30f), limit = (real)(60.0f);
    const real top =
        max_real(choose(share.x > 0.0f, x, none),
                 max_real(choose(share.y > 0.0f, y, none), choose(share.z > 0.0f, z, none)));
    const real3 likely =
        make3(exp2_real(min_real(x - top, limit)), exp2_real(min_real(y - top, limit)),
              exp2_real(min_real(z - top, limit)));
    return scale3(likely, 1.0f / max_real(dot3(share, likely), least));
}

// What paths in `lanes` meet in media with a grid, as medium_event. Where nothing is scattered,
// light is dimmed at each collision instead of being absorbed at one.
INLINE MediumEvent grid_event(SceneView view, Path path, real distance, Sampler sampler,
                              uint bounce, mask lanes) {
    const natural medium = medium_within(path.media);
    const natural grid = RECORD_NATURAL(view.media, medium, MediumRecord, grid);
    const real3 extinction = medium_extinction(view, medium);
    const real3 scattering = RECORD3(view.media, medium, MediumRecord, scattering);
    const mask scatters = nonzero3(scattering);
    const real3 share = shares_of(path.throughput);
    const real2 u = sampler_pair(sampler, media_dimension(bounce));
    const real rate =
        choose(scatters, drawn_rate(extinction, share, u.x), max_component3(extinction));
    const real3 dimming = scale3(extinction, 1.0f / max_real(rate, (real)(1e-30f)));
    real3 left = splat3((real)(1.0f));
    MediumEvent event = no_event(distance, lanes);
    GridWay way = grid_way(view, grid, path.origin, path.direction, (real)(0.0f), distance,
                           stream_key(sampler, media_dimension(bounce)), u.y, lanes);
    for (uint step = 0; step < MOST_GRID_STEPS && mask_bits(way.open); step++) {
        #if ONDE_GLOW
        const GridWay before = way;
        #endif
        const mask collides = grid_step(view, &way, rate);
        #if ONDE_GLOW // of the piece, by a point of it
        const real piece = way.at - before.at;
        const real part = stream_real(before.key ^ 0x5bd1e995u, (natural)(step));
        const real density = grid_density(view, before, fma(piece, part, before.at), before.open);
        const real passed = fma(before.largest * piece, part, before.passed);
        const real3 likely =
            choose(scatters, spectral_weight(extinction, share, passed, before.collisions), left);
        event.glow = choose(before.open, madd3(likely, density * piece, event.glow), event.glow);
        #endif
        if (!mask_bits(collides)) continue;
        const real there = collision_share(view, way, collides);
        const real3 less = mul3(left, sub3(splat3((real)(1.0f)), scale3(dimming, there)));
        left = choose(collides & !scatters, less, left);
        const mask hits = collides & scatters & (grid_random(way, 0u) < there);
        event.scattered = event.scattered | hits;
        way.open = way.open & !hits;
        pass_collision(&way, collides);
    }
    const real3 likely =
        choose(scatters, spectral_weight(extinction, share, way.passed, way.collisions), left);
    const real3 albedo = make3(scattering.x / max_real(extinction.x, (real)(1e-30f)),
                               scattering.y / max_real(extinction.y, (real)(1e-30f)),
                               scattering.z / max_real(extinction.z, (real)(1e-30f)));
    event.weight = choose(event.scattered, mul3(likely, albedo), likely);
    event.weight = choose(way.open, zero3(), event.weight);
    event.at = choose(event.scattered, way.at, distance);
        #if ONDE_GLOW
    event.glow = mul3(event.glow, RECORD3(view.media, medium, MediumRecord, emission));
        #endif
    return event;
}
    #endif

// What the paths in `lanes` meet before the surface that they have hit, if any.
INLINE MediumEvent path_event(SceneView view, Path path, Hits hit, Sampler sampler, uint bounce,
                              mask lanes) {
    const real distance = choose(hit.primitive != BVH_NONE, hit.t, (real)(INFINITE_DISTANCE));
    const natural medium = medium_within(path.media);
    mask even = lanes;
    #if ONDE_GRIDS
    even = lanes & (RECORD_NATURAL(view.media, medium, MediumRecord, grid) == NO_INDEX);
    #endif
    MediumEvent event = medium_event(view, medium, distance, path.throughput,
                                     sampler_pair(sampler, media_dimension(bounce)), even);
    #if ONDE_GRIDS
    const mask gridded = lanes & !even;
    if_any (gridded) {
        const MediumEvent other = grid_event(view, path, distance, sampler, bounce, gridded);
        event.scattered = event.scattered | (gridded & other.scattered);
        event.at = choose(gridded, other.at, event.at);
        event.weight = choose(gridded, other.weight, event.weight);
        #if ONDE_GLOW
        event.glow = choose(gridded, other.glow, event.glow);
        #endif
    }
    #endif
    return event;
}

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
