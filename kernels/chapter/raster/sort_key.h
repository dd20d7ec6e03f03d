// Depths as integers to sort by.
#ifndef ONDE_CHAPTER_RASTER_SORT_KEY_H
#define ONDE_CHAPTER_RASTER_SORT_KEY_H

#include "math/lanes.h"

// Ascending keys go from the farthest to the nearest; -0 and 0 have the same one.
INLINE uint far_to_near_key(float depth) {
    const uint sign = 0x80000000u, bits = as_uint(depth) == sign ? 0u : as_uint(depth);
    return bits & sign ? bits : ~bits & ~sign;
}

#endif
