// Where light that was connected to the camera is added: any pixel, by any work item, at any time.
// Sums are fixed-point, so that no order of the additions changes a bit.
#ifndef ONDE_FILM_SPLAT_H
#define ONDE_FILM_SPLAT_H

#include "film/film.h"
#include "shared/light_tracing.h"

#define WORD_RANGE 4294967296.0f // 2^32

// Adds to a 64-bit sum of two words; returns the carry out of it. The carries do not depend on the
// order of the additions either. (Two 32-bit additions, because 64-bit atomics are an extension.)
INLINE uint sum_add(__global uint* words, uint low, uint high) {
    const uint old_low = atomic_add(&words[0], low);
    high += old_low + low < low; // `high` is far from its own end
    if (high == 0) return 0;
    const uint old_high = atomic_add(&words[1], high);
    return old_high + high < high;
}

typedef struct {
    __global uint* sums; // SPLAT_WORDS a pixel
    __global uint* statistics;
    float scale;
} SplatView;

// Neither a number below zero, nor one that fixed point can't hold, nor NaN.
INLINE bool splat_fits(float scaled) {
    return scaled >= 0.0f && scaled < 1073741824.0f * WORD_RANGE; // 2^62
}

INLINE void channel_add(__global uint* words, float scaled) {
    const float whole = rint(scaled);
    const uint high = (uint)(whole / WORD_RANGE);
    if (sum_add(words, (uint)(whole - (float)high * WORD_RANGE), high)) atomic_inc(&words[2]);
}

// Adds one splat; returns whether it could be added.
INLINE bool splat_add(SplatView splats, uint pixel, float3 value) {
    const float3 scaled = value * splats.scale;
    if (!splat_fits(scaled.x) || !splat_fits(scaled.y) || !splat_fits(scaled.z)) return false;
    __global uint* words = splats.sums + (size_t)pixel * SPLAT_WORDS;
    channel_add(words, scaled.x);
    channel_add(words + 3, scaled.y);
    channel_add(words + 6, scaled.z);
    return true;
}

#endif
