// All stages and bounces of a chunk of paths in one work item: a wavefront that lives in the cache.
// `count` is the number of paths of the wave.
#include "film/tally.h"
#include "wavefront/queue.h"

__kernel void fused(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, STATE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    SCENE_VIEW(view);
    WAVE_VIEW(wave);
    WAVE_JOB(job);
    FILM_VIEW(film);
    const uint begin = range.begin;
    stage_generate(view, wave, job, begin, range.end);
    uint end = range.end;
    for (uint b = 0; begin < end; b++) {
        count_rays(counters, COUNTER_EXTENSION, b, end - begin);
        stage_intersect(view, wave, b, begin, end);
        const uint rays = stage_shade(view, wave, job, b, begin, end);
        count_rays(counters, COUNTER_SHADOW, b, rays);
        stage_shadow(view, wave, begin, end);
        end = begin + stage_extend(wave, wave, begin, end, begin);
    }
    stage_accumulate(wave, job, film, begin, range.end);
}
