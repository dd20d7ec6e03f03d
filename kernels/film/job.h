// What a wave works on, as every engine sees it: its paths, the pixels and samples they stand for,
// the share of a work item, and the ray counters.
#ifndef ONDE_FILM_JOB_H
#define ONDE_FILM_JOB_H

#include "math/lanes.h"
#include "shared/frame.h"

// Whether the host counts what samples see.
#ifndef ONDE_IDS
    #define ONDE_IDS 0
#endif

// Path i of a wave works on pixel_order[first_pixel + i / samples], sample
// first_sample + i % samples; samples is 2^log2_samples.
typedef struct {
    __global const uint* pixel_order; // x | y << 16
    uint first_pixel, first_sample, log2_samples;
    __global uint* counters; // see COUNTER_BOUNCES
#if ONDE_IDS
    __global uint* seen; // SEEN_WORDS a path
#endif
} WaveJob;

// How much there is to do, as the first parameters of every kernel of a wave: `count` paths, of
// which a work item owns `chunk`, a multiple of the samples per pixel.
#define LAUNCH_PARAMETERS                                                                          \
    uint count, uint chunk, uint first_pixel, uint first_sample, uint log2_samples

#if ONDE_IDS
    #define SEEN_PARAMETER , __global uint* seen
    #define JOB_SEEN(job) job.seen = seen
#else
    #define SEEN_PARAMETER
    #define JOB_SEEN(job)
#endif

// What is the same for all waves, in the order in which the host binds it.
#define JOB_PARAMETERS                                                                             \
    __global uint *counters, __global uint *invalid, __global float4 *film_sums,                   \
        __global const uint *pixel_order SEEN_PARAMETER

#define WAVE_JOB(job)                                                                              \
    WaveJob job;                                                                                   \
    job.pixel_order = pixel_order;                                                                 \
    job.first_pixel = first_pixel;                                                                 \
    job.first_sample = first_sample;                                                               \
    job.log2_samples = log2_samples;                                                               \
    job.counters = counters;                                                                       \
    JOB_SEEN(job)

INLINE natural job_pixel(WaveJob job, natural path) {
    return gather_natural(job.pixel_order, (path >> job.log2_samples) + job.first_pixel);
}
INLINE natural job_sample(WaveJob job, natural path) {
    return (path & ((1u << job.log2_samples) - 1u)) + job.first_sample;
}

// The same of one path.
INLINE uint path_pixel(WaveJob job, uint path) {
    return job.pixel_order[(path >> job.log2_samples) + job.first_pixel];
}
INLINE uint path_sample(WaveJob job, uint path) {
    return (path & ((1u << job.log2_samples) - 1u)) + job.first_sample;
}

#if ONDE_IDS
// Tells the host what the paths in `bits` have met first.
INLINE void store_seen(WaveJob job, natural id, natural primitive, natural instance, uint bits) {
    float path[ONDE_WIDTH], met[ONDE_WIDTH], placed[ONDE_WIDTH];
    spill_real(path, as_real(id));
    spill_real(met, as_real(primitive));
    spill_real(placed, as_real(instance));
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        __global uint* seen = job.seen + (size_t)as_uint(path[k]) * SEEN_WORDS;
        seen[SEEN_PRIMITIVE] = as_uint(met[k]);
        seen[SEEN_INSTANCE] = as_uint(placed[k]);
    }
}
#endif

typedef struct {
    uint begin, end;
} Range;

// The paths of this work item, of `count` in all.
INLINE Range whole_range(uint count, uint chunk) {
    Range range;
    range.begin = min((uint)get_global_id(0) * chunk, count);
    range.end = min(range.begin + chunk, count);
    return range;
}

// Lanes of the group at i that lie before `end`.
INLINE mask group_lanes(uint i, uint end) {
    return lane_index() + i < end;
}

// Adds to a counter of the table; the length of a global queue is such a counter.
INLINE void count_rays(__global uint* counters, uint row, uint bounce, uint rays) {
    if (rays) atomic_add(&counters[row * COUNTER_BOUNCES + bounce], rays);
}

// The same of `rays` by lane, where levels differ from lane to lane.
INLINE void count_by_level(__global uint* counters, uint row, natural level, natural rays) {
    float level_of[ONDE_WIDTH];
    spill_real(level_of, as_real(level));
    uint bits = mask_bits(rays != 0u);
    while (bits) {
        const mask same = level == as_uint(level_of[lowest_bit(bits)]);
        count_rays(counters, row, as_uint(level_of[lowest_bit(bits)]),
                   sum_natural(choose(same, rays, (natural)(0u))));
        bits &= ~mask_bits(same);
    }
}

#endif
