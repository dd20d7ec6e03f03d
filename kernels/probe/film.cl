// film_add over samples that a test made up.
#include "film/film.h"

// `count` pixels, one per work item; radiance: `samples` of each, one after the other.
__kernel void probe_film(uint count, uint samples, __global const uint* pixel_order,
                         __global const float4* radiance, __global float4* sums,
                         __global uint* invalid) {
    const uint pixel = get_global_id(0);
    if (pixel >= count) return;
    FilmView film;
    film.sums = sums;
    film.invalid = invalid;
    film.width = film.pixels = count;
    WaveJob job;
    job.pixel_order = pixel_order;
    job.first_pixel = pixel;
    job.first_sample = job.log2_samples = 0;
    for (uint i = 0; i < samples; i++) film_add(film, job, 0, radiance[pixel * samples + i]);
}
