// The path tracer as the schedulers see it.
#ifndef ONDE_PATH_ESTIMATOR_H
#define ONDE_PATH_ESTIMATOR_H

#include "film/job.h"
#include "path/path.h"

#define ESTIMATOR_TREE 0
#define ESTIMATOR_EMITS 1
#define ESTIMATOR_TRANSLUCENT 0
#define ESTIMATOR_CONNECTS_START 0
#define ESTIMATOR_SPLATS 0
#define ESTIMATOR_COLUMNS PATH_COLUMNS
#define ESTIMATOR_CONNECTIONS CONNECTION_COLUMNS
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

INLINE Sampler path_sampler(Estimator e, natural id) {
    return sampler_start(job_pixel(e.job, id), job_sample(e.job, id), e.view.frame->seed);
}

// The camera rays of paths `id`.
INLINE State estimator_start(Estimator e, natural id) {
    return path_start(e.view.frame, job_pixel(e.job, id), path_sampler(e, id));
}

INLINE Step estimator_vertex(Estimator e, State path, Hits hits, natural id, uint bounce,
                             mask lanes) {
    return path_vertex(e.view, path, hits, path_sampler(e, id), bounce, lanes);
}

#endif
