// Which slots a work item works on. Two kinds of queue:
//
// Chunk-local (CPUs): a work item owns `chunk` slots, its live paths are the first live[c] of
// them, and it compacts in place: no atomics, no order lost, no second copy.
// Global (GPUs): live paths fill the wave densely; the counter table holds how many; the work is
// shared out evenly, so that a CPU that runs this kind is not left with one busy thread.
#ifndef ONDE_WAVEFRONT_QUEUE_H
#define ONDE_WAVEFRONT_QUEUE_H

#include "wavefront/stages.h"

#ifndef ONDE_GLOBAL_QUEUE
    #define ONDE_GLOBAL_QUEUE 0
#endif

// The wave's memory as kernel parameters, in the order in which the host binds them.
#define STATE_PARAMETERS                                                                           \
    __global float *state, __global float *next_state, __global float *shadow,                     \
        __global float4 *radiance, uint stride, __global uint *live, uint bounce

#define WAVE_VIEW(view)                                                                            \
    WaveView view;                                                                                 \
    view.state = state;                                                                            \
    view.shadow = shadow;                                                                          \
    view.radiance = radiance;                                                                      \
    view.stride = stride

// The live slots of this work item.
INLINE Range live_range(uint count, uint chunk, __global const uint* live,
                        __global const uint* counters, uint bounce) {
    Range range = whole_range(count, chunk);
#if ONDE_GLOBAL_QUEUE
    const uint total = counters[COUNTER_EXTENSION * COUNTER_BOUNCES + bounce];
    const uint items = (count + chunk - 1) / chunk;
    const uint groups = (total + ONDE_WIDTH - 1) / ONDE_WIDTH;
    const uint share = (groups + items - 1) / items * ONDE_WIDTH;
    range.begin = min((uint)get_global_id(0) * share, total);
    range.end = min(range.begin + share, total);
#else
    if (range.begin < count) range.end = range.begin + live[get_global_id(0)];
#endif
    return range;
}

#endif
