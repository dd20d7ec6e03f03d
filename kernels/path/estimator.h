// The path tracer as the schedulers see it.
#ifndef ONDE_PATH_ESTIMATOR_H
#define ONDE_PATH_ESTIMATOR_H

#include "film/job.h"
#include "film/light_shares.h"
#include "path/path.h"

#define ESTIMATOR_TREE 0
#define ESTIMATOR_EMITS 1
#define ESTIMATOR_TRANSLUCENT (ONDE_ALPHA || ONDE_STRAIGHT)
#define ESTIMATOR_CONNECTS_START 0
#define ESTIMATOR_SPLATS 0
#define ESTIMATOR_WAYS ONDE_WAYS
#define ESTIMATOR_COLUMNS PATH_STATE
#if ONDE_TRAIL
    #define PATH_SHARES SHARE_COLUMNS
#else
    #define PATH_SHARES NO_COLUMNS
#endif
#if ONDE_WAYS
    #define PATH_WAY WAY_COLUMNS
#else
    #define PATH_WAY NO_COLUMNS
#endif
#if ONDE_GROUPS
    #define PATH_TARGET TARGET_COLUMNS
#else
    #define PATH_TARGET NO_COLUMNS
#endif
#define ESTIMATOR_CONNECTIONS(VECTOR, REAL, NATURAL)                                               \
    CONNECTION_COLUMNS(VECTOR, REAL, NATURAL)                                                      \
    PATH_TARGET(VECTOR, REAL, NATURAL)                                                             \
    PATH_SHARES(VECTOR, REAL, NATURAL) PATH_WAY(VECTOR, REAL, NATURAL)
typedef Path State;
typedef PathVertex Step;

// It needs nothing beside scene and job.
#define ESTIMATOR_PARAMETERS
typedef struct {
    SceneView view;
    WaveJob job;
} Estimator;
#define ESTIMATOR(e)                                                                               \
    SCENE_VIEW(scene_view);                                                                        \
    WAVE_JOB(wave_job);                                                                            \
    const Estimator e = {scene_view, wave_job}

#if ONDE_TRAIL
INLINE LightShares trail_shares(State path) {
    LightShares shares;
    shares.diffuse = path.diffuse;
    shares.transmitted = path.transmitted;
    return shares;
}
#endif

INLINE Sampler path_sampler(Estimator e, natural id) {
    return sampler_start(job_pixel(e.job, id), job_sample(e.job, id), e.view.frame->seed);
}

// The camera rays of paths `id`.
INLINE State estimator_start(Estimator e, natural id) {
    return path_start(e.view.frame, job_pixel(e.job, id), path_sampler(e, id));
}

#if ONDE_SEEN_THROUGH
// Backs are culled where no light was sampled along the ray: for the camera's, and after mirrors.
INLINE mask estimator_culls(State path, mask lanes) {
    return lanes & (path.pdf <= 0.0f);
}

INLINE Hits estimator_pass(Estimator e, State path, Hits hits, natural id, uint bounce,
                           mask lanes) {
    real u = (real)(0.0f);
    #if ONDE_ALPHA
    u = sampler_pair(path_sampler(e, id), bounce_dimension(bounce, DIMENSION_ROULETTE)).y;
    #endif
    return pass_surfaces(e.view, path.origin, path.direction, hits, u, estimator_culls(path, lanes),
                         lanes);
}
#endif

#if ESTIMATOR_TRANSLUCENT
INLINE real3 estimator_transmittance(Estimator e, real3 origin, real3 direction, real distance,
                                     natural way, natural id, uint bounce, mask lanes) {
    const natural key = stream_key(path_sampler(e, id), connection_dimension(bounce));
    return ray_transmittance(e.view, origin, direction, distance, direction, lanes & !lanes, way,
                             key, lanes);
}
#endif

INLINE Step estimator_vertex(Estimator e, State path, Hits hits, natural id, uint bounce,
                             mask lanes) {
    const Step step = path_vertex(e.view, path, hits, path_sampler(e, id), bounce, lanes);
#if ONDE_GROUND
    count_rays(e.job.counters, COUNTER_SHADOW, bounce, popcount(step.tested));
#endif
    return step;
}

#endif
