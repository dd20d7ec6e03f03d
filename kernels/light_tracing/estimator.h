// The light tracer as the schedulers see it: a path starts with a connection of the light itself,
// and connections go to any pixel.
#ifndef ONDE_LIGHT_TRACING_ESTIMATOR_H
#define ONDE_LIGHT_TRACING_ESTIMATOR_H

#include "film/splat.h"
#include "light_tracing/light_tracing.h"

#define ESTIMATOR_TREE 0
#define ESTIMATOR_EMITS 0
#define ESTIMATOR_TRANSLUCENT (ONDE_SEEN_THROUGH || ONDE_PANES || ONDE_MEDIA)
#define ESTIMATOR_CONNECTS_START 1
#define ESTIMATOR_SPLATS 1
#define ESTIMATOR_WAYS 0
#define ESTIMATOR_COLUMNS LIGHT_STATE
#define ESTIMATOR_CONNECTIONS SPLAT_COLUMNS

typedef LightPath State;
typedef LightVertex Step;

#define ESTIMATOR_PARAMETERS                                                                       \
    , __global const LightTracingRecord *light_setup, __global uint *splat_sums,                   \
        __global uint *splat_statistics

typedef struct {
    SceneView view;
    WaveJob job;
    __global const LightTracingRecord* setup;
    SplatView splats;
} Estimator;
#define ESTIMATOR(e)                                                                               \
    SCENE_VIEW(scene_view);                                                                        \
    WAVE_JOB(wave_job);                                                                            \
    const SplatView splat_view = {splat_sums, splat_statistics, light_setup->splat_scale};         \
    const Estimator e = {scene_view, wave_job, light_setup, splat_view}

INLINE Sampler path_sampler(Estimator e, natural id) {
    const natural index = (id >> e.job.log2_samples) + e.job.first_pixel;
    return light_sampler(e.view.frame, index, job_sample(e.job, id));
}

INLINE Step estimator_start(Estimator e, natural id, mask lanes) {
    return light_start(e.view, e.setup, path_sampler(e, id), lanes);
}

#if ONDE_SEEN_THROUGH
INLINE mask estimator_culls(State path, mask lanes) {
    return lanes & !lanes;
}

INLINE Hits estimator_pass(Estimator e, State path, Hits hits, natural id, uint bounce,
                           mask lanes) {
    #if ONDE_ALPHA
    const real2 u = sampler_pair(path_sampler(e, id), passing_dimension(bounce));
    return pass_surfaces(e.view, path.origin, path.direction, hits, u.x, lanes & !lanes, lanes);
    #else
    return hits;
    #endif
}
#endif

#if ESTIMATOR_TRANSLUCENT
// Connections show the scene to the camera, which looks against them; only those of the environment
// run with its sight.
INLINE real3 estimator_transmittance(Estimator e, real3 origin, real3 direction, real distance,
                                     natural way, natural id, uint bounce, mask lanes) {
    const real3 seen = choose(distance < INFINITE_DISTANCE, negate3(direction), direction);
    return ray_transmittance(e.view, origin, direction, distance, seen, lanes, way, id, lanes);
}
#endif

INLINE Step estimator_vertex(Estimator e, State path, Hits hits, natural id, uint bounce,
                             mask lanes) {
    return light_vertex(e.view, path, hits, path_sampler(e, id), bounce, lanes);
}

// Adds an unblocked connection of a path to its pixel, unless it is not finite. For the path's sum:
// x counts unblocked connections, w those of surfaces that were added. (That the camera sees the
// light itself, vertex 0, is not the ray's merit.)
INLINE float4 estimator_splat(Estimator e, FilmView film, uint path, uint vertex, uint target,
                              float3 value) {
    const bool added = splat_add(e.splats, target, value);
    if (!added) film_reject(film, path_pixel(e.job, path), path_sample(e.job, path));
    return (float4)(1.0f, 0.0f, 0.0f, added && vertex > 0 ? 1.0f : 0.0f);
}

// What paths that have ended tell of themselves: how many of them contributed to some pixel, and
// their unblocked connections.
INLINE void estimator_tell(Estimator e, uint contributed, uint unblocked) {
    sum_add(&e.splats.statistics[2 * LIGHT_CONTRIBUTED], contributed, 0);
    sum_add(&e.splats.statistics[2 * LIGHT_UNBLOCKED], unblocked, 0);
}

#endif
