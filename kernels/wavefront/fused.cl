// All stages and bounces of a chunk of paths in one work item: a wavefront that lives in the cache,
// compacted in place, for any estimator. `count` is the number of paths of the wave.
#include "film/tally.h"
#include "wavefront/stages.h"

__kernel void fused(LAUNCH_PARAMETERS, SCENE_PARAMETERS, JOB_PARAMETERS ESTIMATOR_PARAMETERS,
                    WAVE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    ESTIMATOR(e);
    WAVE_VIEW(wave);
    FILM_VIEW(film);
    const uint begin = range.begin;
    uint end = range.end;
    stage_generate(e, wave, begin, end);
#if ESTIMATOR_CONNECTS_START
    count_path_rays(e.job, COUNTER_SHADOW, 0, stage_connect(e, wave, film, 0, begin, end));
    end = begin + stage_extend(wave, wave.state, begin, end, begin);
#endif
    for (uint b = 0; begin < end; b++) {
        count_path_rays(e.job, COUNTER_EXTENSION, b, end - begin);
        stage_intersect(e, wave, b, begin, end);
#if ESTIMATOR_TREE
        stage_visit(e, wave, begin, end);
#else
        stage_shade(e, wave, b, begin, end);
        const uint vertex = b + ESTIMATOR_CONNECTS_START;
        const uint rays = stage_connect(e, wave, film, vertex, begin, end);
        count_path_rays(e.job, COUNTER_SHADOW, vertex, rays);
#endif
        end = begin + stage_extend(wave, wave.state, begin, end, begin);
    }
    stage_accumulate(e, wave, film, begin, range.end);
}
