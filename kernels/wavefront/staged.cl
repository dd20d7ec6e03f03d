// One kernel per stage, over a queue that all work items share: for GPUs, for tests of single
// stages, for profiles. Live paths fill the slots densely; `queue` holds how many there are, for
// steps of either parity. `count` is the number of paths of the wave. The host exchanges the two
// copies of the state after each extension.
#include "film/tally.h"
#include "wavefront/stages.h"

// In the order in which the host binds them: what changes from launch to launch comes first.
#define STAGE_PARAMETERS                                                                           \
    LAUNCH_PARAMETERS, uint step, SCENE_PARAMETERS, JOB_PARAMETERS ESTIMATOR_PARAMETERS,           \
        WAVE_PARAMETERS, __global float *next_state, __global uint *queue

// The live slots of this work item: the work is shared out evenly among as many items as the wave
// has chunks, so that a CPU is not left with one busy thread.
INLINE Range live_range(uint count, uint chunk, __global const uint* queue, uint step) {
    const uint total = queue[step & 1];
    const uint items = (count + chunk - 1) / chunk;
    const uint groups = (total + ONDE_WIDTH - 1) / ONDE_WIDTH;
    const uint share = (groups + items - 1) / items * ONDE_WIDTH;
    Range range;
    range.begin = min((uint)get_global_id(0) * share, total);
    range.end = min(range.begin + share, total);
    return range;
}

__kernel void generate(STAGE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    if (get_global_id(0) == 0) {
        queue[0] = count;
        queue[1] = 0;
    }
    ESTIMATOR(e);
    WAVE_VIEW(wave);
    stage_generate(e, wave, range.begin, range.end);
}

__kernel void intersect(STAGE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, queue, step);
    const uint bounce = step - ESTIMATOR_CONNECTS_START;
    ESTIMATOR(e);
    WAVE_VIEW(wave);
    if (get_global_id(0) == 0) {
        count_path_rays(e.job, COUNTER_EXTENSION, bounce, queue[step & 1]);
        queue[(step + 1) & 1] = 0;
    }
    stage_intersect(e, wave, bounce, range.begin, range.end);
}

__kernel void shade(STAGE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, queue, step);
    if (range.begin == range.end) return;
    ESTIMATOR(e);
    WAVE_VIEW(wave);
    stage_shade(e, wave, step - ESTIMATOR_CONNECTS_START, range.begin, range.end);
}

// Rays are counted in the work group, so that it needs one global atomic.
__kernel void connect(STAGE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, queue, step);
    ESTIMATOR(e);
    WAVE_VIEW(wave);
    FILM_VIEW(film);
    __local uint group_rays;
    if (get_local_id(0) == 0) group_rays = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint rays = stage_connect(e, wave, film, step, range.begin, range.end);
    if (rays) atomic_add(&group_rays, rays);
    barrier(CLK_LOCAL_MEM_FENCE);
    if (get_local_id(0) == 0) count_path_rays(e.job, COUNTER_SHADOW, step, group_rays);
}

#if ESTIMATOR_TREE
__kernel void sample(STAGE_PARAMETERS, uint k) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, queue, step);
    if (range.begin == range.end) return;
    ESTIMATOR(e);
    WAVE_VIEW(wave);
    stage_sample(e, wave, k, range.begin, range.end);
}

__kernel void advance(STAGE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, queue, step);
    if (range.begin == range.end) return;
    ESTIMATOR(e);
    WAVE_VIEW(wave);
    stage_advance(e, wave, range.begin, range.end);
}
#endif

// Appends are gathered in the work group, so that it needs one global atomic.
__kernel void extend(STAGE_PARAMETERS) {
    if (count == 0) return;
    const Range range = live_range(count, chunk, queue, step);
    WAVE_VIEW(wave);
    __local uint group_count, group_first;
    if (get_local_id(0) == 0) group_count = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint mine = atomic_add(&group_count, count_alive(wave, range.begin, range.end));
    barrier(CLK_LOCAL_MEM_FENCE);
    if (get_local_id(0) == 0) group_first = atomic_add(&queue[(step + 1) & 1], group_count);
    barrier(CLK_LOCAL_MEM_FENCE);
    const Columns next = {next_state, stride};
    stage_extend(wave, next, range.begin, range.end, group_first + mine);
}

__kernel void accumulate(STAGE_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    ESTIMATOR(e);
    WAVE_VIEW(wave);
    FILM_VIEW(film);
    stage_accumulate(e, wave, film, range.begin, range.end);
}
