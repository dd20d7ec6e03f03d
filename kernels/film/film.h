// Where radiance ends: sums and sample counts per pixel.
#ifndef ONDE_FILM_FILM_H
#define ONDE_FILM_FILM_H

#include "film/job.h"

typedef struct {
    __global float4* sums;  // by y * width + x: red, green, blue, number of samples
    __global uint* invalid; // see INVALID_COUNT
    uint width;
} FilmView;

#define FILM_VIEW(view)                                                                            \
    FilmView view;                                                                                 \
    view.sums = film_sums;                                                                         \
    view.invalid = invalid;                                                                        \
    view.width = frame->width

// Not-finite radiance never reaches the film: it is counted, and the first one is remembered.
INLINE void film_reject(FilmView film, uint pixel, uint sample) {
    if (atomic_inc(&film.invalid[INVALID_COUNT]) == 0) {
        film.invalid[INVALID_PIXEL] = pixel;
        film.invalid[INVALID_SAMPLE] = sample;
    }
}

// Adds one sample. The samples of a pixel lie next to each other in a wave, in ascending order, and
// one work item adds them one by one: no split of the work changes a bit of the sum.
INLINE void film_add(FilmView film, WaveJob job, uint path, float4 radiance) {
    const uint pixel = path_pixel(job, path);
    const float sum = radiance.x + radiance.y + radiance.z;
    if (!(fabs(sum) < MAXFLOAT)) {
        film_reject(film, pixel, path_sample(job, path));
        return;
    }
    film.sums[(size_t)(pixel >> 16) * film.width + (pixel & 0xffffu)] +=
        (float4)(radiance.x, radiance.y, radiance.z, 1.0f);
}

#endif
