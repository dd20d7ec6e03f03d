// Adds the counter table of a finished wave to the frame's totals and clears it for the next one.
#include "shared/frame.h"

__kernel void tally(uint count, __global uint* counters, __global ulong* totals) {
    if (count == 0 || get_global_id(0) >= COUNTER_SIZE) return;
    totals[get_global_id(0)] += counters[get_global_id(0)];
    counters[get_global_id(0)] = 0;
}
