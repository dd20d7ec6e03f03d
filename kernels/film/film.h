// Where radiance ends: sums and sample counts per pixel.
#ifndef ONDE_FILM_FILM_H
#define ONDE_FILM_FILM_H

#include "film/aovs.h"
#include "film/job.h"

typedef struct {
    __global float4* sums; // by y * width + x: red, green, blue, number of samples; the AOVs behind
    __global uint* invalid; // see INVALID_COUNT
    uint width, pixels;
    float most_radiance; // of a sample
} FilmView;

#define FILM_VIEW(view)                                                                            \
    FilmView view;                                                                                 \
    view.sums = film_sums;                                                                         \
    view.invalid = invalid;                                                                        \
    view.width = frame->width;                                                                     \
    view.pixels = frame->width * frame->height;                                                    \
    view.most_radiance = frame->most_radiance

// Not-finite radiance never reaches the film: it is counted, and the first one is remembered.
INLINE void film_reject(FilmView film, uint pixel, uint sample) {
    if (atomic_inc(&film.invalid[INVALID_COUNT]) == 0) {
        film.invalid[INVALID_PIXEL] = pixel;
        film.invalid[INVALID_SAMPLE] = sample;
    }
}

// The share of a sample that is not cut off: all of it, in films that are not clamped.
INLINE float kept_share(FilmView film, float4 radiance) {
#if ONDE_AOVS
    const float largest = fmax(fmax(radiance.x, radiance.y), radiance.z);
    if (HAS_AOV(CLAMPED) && largest > film.most_radiance) return film.most_radiance / largest;
#endif
    return 1.0f;
}

// Adds one sample. The samples of a pixel lie next to each other in a wave, in ascending order, and
// one work item adds them one by one: no split of the work changes a bit of the sum. Returns
// whether it could be added.
INLINE bool film_add(FilmView film, WaveJob job, uint path, float4 radiance) {
    const uint pixel = path_pixel(job, path);
    const float sum = radiance.x + radiance.y + radiance.z;
    if (!(fabs(sum) < MAXFLOAT)) {
        film_reject(film, pixel, path_sample(job, path));
#if ONDE_IDS
        job.seen[(size_t)path * SEEN_WORDS + SEEN_PRIMITIVE] = SEEN_REJECTED;
#endif
        return false;
    }
    film.sums[(size_t)(pixel >> 16) * film.width + (pixel & 0xffffu)] +=
        (float4)(radiance.x, radiance.y, radiance.z, 1.0f);
    return true;
}

// The same of another plane, for a sample whose radiance was added. What is not finite counts as 0.
INLINE void film_add_aov(FilmView film, WaveJob job, uint path, uint plane, float4 value) {
    const uint pixel = path_pixel(job, path);
    const float sum = value.x + value.y + value.z;
    if (!(fabs(sum) < MAXFLOAT)) value = (float4)(0.0f);
    film.sums[(size_t)plane * film.pixels + (size_t)(pixel >> 16) * film.width +
              (pixel & 0xffffu)] += (float4)(value.x, value.y, value.z, 1.0f);
}

// The same of the AOVs that are functions of the sample's radiance, behind `plane`.
INLINE void film_add_sample_aovs(FilmView film, WaveJob job, uint path, uint plane, float4 radiance,
                                 float kept) {
#if ONDE_AOVS
    if (HAS_AOV(SQUARES)) film_add_aov(film, job, path, ++plane, sample_squares(radiance * kept));
    if (HAS_AOV(CLAMPED)) film_add_aov(film, job, path, ++plane, radiance * (1.0f - kept));
    if (HAS_AOV(HALVES) && ++plane && (path_sample(job, path) & HALF_BLOCK))
        film_add_aov(film, job, path, plane, radiance * kept);
#endif
}

#endif
