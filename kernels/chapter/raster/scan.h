// The kernel between counting by block and moving: counts become places.
#ifndef ONDE_CHAPTER_RASTER_SCAN_H
#define ONDE_CHAPTER_RASTER_SCAN_H

#include "math/lanes.h"

// Interleaved each column of `blocks` counts into what comes before it; `totals` gets their sums.
// `count` columns, one work item each: digits here, tiles of the picture for the painter.
__kernel void scan_columns(uint count, uint blocks, __global uint* table, __global uint* totals) {
    const uint column = get_global_id(0);
    if (column >= count) return;
    uint sum = 0;
    for (uint b = 0; b < blocks; b++) {
        __global uint* entry = table + (size_t)b * count + column;
        const uint own = *entry;
        *entry = sum;
        sum += own;
    }
    totals[column] = sum;
}

#endif
