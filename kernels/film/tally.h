// The kernel that ends a wave: adds its counter table to the frame's totals and clears it for the
// next one.
#ifndef ONDE_FILM_TALLY_H
#define ONDE_FILM_TALLY_H

#include "shared/frame.h"

__kernel void tally(uint count, __global uint* counters, __global ulong* totals) {
    if (get_global_id(0) >= min(count, (uint)COUNTER_SIZE)) return;
    totals[get_global_id(0)] += counters[get_global_id(0)];
    counters[get_global_id(0)] = 0;
}

#endif
