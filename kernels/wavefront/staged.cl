// One kernel per stage: for GPUs, for tests of single stages, for profiles.
// `count` is the number of paths of the wave.
#include "film/tally.h"
#include "wavefront/queue.h"

__kernel void generate(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, STATE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    SCENE_VIEW(view);
    WAVE_VIEW(wave);
    WAVE_JOB(job);
    stage_generate(view, wave, job, range.begin, range.end);
    live[get_global_id(0)] = range.end - range.begin;
    count_rays(counters, COUNTER_EXTENSION, 0, range.end - range.begin);
}

__kernel void intersect(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, STATE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, live, counters, bounce);
    if (range.begin == range.end) return;
    SCENE_VIEW(view);
    WAVE_VIEW(wave);
    stage_intersect(view, wave, bounce, range.begin, range.end);
}

__kernel void shade(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, STATE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, live, counters, bounce);
    if (range.begin == range.end) return;
    SCENE_VIEW(view);
    WAVE_VIEW(wave);
    WAVE_JOB(job);
    const uint rays = stage_shade(view, wave, job, bounce, range.begin, range.end);
    count_rays(counters, COUNTER_SHADOW, bounce, rays);
}

__kernel void shadow_test(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, STATE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, live, counters, bounce);
    if (range.begin == range.end) return;
    SCENE_VIEW(view);
    WAVE_VIEW(wave);
    stage_shadow(view, wave, range.begin, range.end);
}

__kernel void extend(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, STATE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, live, counters, bounce);
    WAVE_VIEW(wave);
#if ONDE_GLOBAL_QUEUE
    // Appends are gathered in the work group, so that it needs one global atomic.
    __local uint group_count, group_first;
    if (get_local_id(0) == 0) group_count = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint mine = atomic_add(&group_count, count_alive(wave, range.begin, range.end));
    barrier(CLK_LOCAL_MEM_FENCE);
    if (get_local_id(0) == 0)
        group_first =
            atomic_add(&counters[COUNTER_EXTENSION * COUNTER_BOUNCES + bounce + 1], group_count);
    barrier(CLK_LOCAL_MEM_FENCE);
    WaveView next = wave;
    next.state = next_state;
    stage_extend(wave, next, range.begin, range.end, group_first + mine);
#else
    if (range.begin == range.end) return;
    const uint alive = stage_extend(wave, wave, range.begin, range.end, range.begin);
    live[get_global_id(0)] = alive;
    count_rays(counters, COUNTER_EXTENSION, bounce + 1, alive);
#endif
}

__kernel void accumulate(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, STATE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    WAVE_VIEW(wave);
    WAVE_JOB(job);
    FILM_VIEW(film);
    stage_accumulate(wave, job, film, range.begin, range.end);
}
