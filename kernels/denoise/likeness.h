// How like two pixels are: by their radiance as far as its variance tells (non-local means,
// Rousselle et al. 2012, Adaptive Rendering with Non-Local Means Filtering, equation 4), and by
// what they show (Rousselle et al. 2013, Robust Denoising using Feature and Color Information,
// section 5.1). Differences of the channels are added before they are compared with their
// variances, and the surer of two pixels bounds the variance of the other, so that it takes little
// of an outlier.
#ifndef ONDE_DENOISE_LIKENESS_H
#define ONDE_DENOISE_LIKENESS_H

#include "denoise/planes.h"

// Differences of radiance count from the standard deviation times about 0.55 on.
#define VARIANCE_SCALE 0.3f
// The most variance of the other pixel, in variances of this one.
#define UNSURER 10.0f

typedef struct {
    Planes radiance, variance;                      // of what is compared
    Planes albedo, normal, depth;                   // of what is seen
    Planes albedo_scale, normal_scale, depth_scale; // see GUIDE_ALBEDO
} Likeness;

INLINE Likeness likeness_of(__global const DenoiseBand* band, __global const float* noisy,
                            __global const float* limited, __global const float* guides) {
    Likeness l;
    l.radiance = planes_at(band, limited, LIMITED_RADIANCE);
    l.variance = planes_at(band, guides, GUIDE_VARIANCE);
    l.albedo = planes_at(band, noisy, NOISY_ALBEDO);
    l.normal = planes_at(band, noisy, NOISY_NORMAL);
    l.depth = planes_at(band, noisy, NOISY_DEPTH);
    l.albedo_scale = planes_at(band, guides, GUIDE_ALBEDO);
    l.normal_scale = planes_at(band, guides, GUIDE_NORMAL);
    l.depth_scale = planes_at(band, guides, GUIDE_DEPTH);
    return l;
}

// Of the radiance of the pixels at a and b, in variances; below 0 where they differ by less than
// their noise.
INLINE real radiance_difference(Likeness l, uint a, uint b) {
    const real3 difference = square3(sub3(load_planes(l.radiance, a), load_planes(l.radiance, b)));
    const real3 mine = load_planes(l.variance, a), other = load_planes(l.variance, b);
    const real3 noise =
        make3(mine.x + min_real(mine.x, other.x), mine.y + min_real(mine.y, other.y),
              mine.z + min_real(mine.z, other.z));
    const real3 scale = make3(mine.x + min_real(UNSURER * mine.x, other.x),
                              mine.y + min_real(UNSURER * mine.y, other.y),
                              mine.z + min_real(UNSURER * mine.z, other.z));
    return sum_of(sub3(difference, noise)) / (VARIANCE_SCALE * sum_of(scale) + 1e-20f);
}

INLINE real scaled_by(Planes scale, uint a, uint b, real square_of_difference) {
    return square_of_difference * min_real(load_plane(scale, a), load_plane(scale, b));
}

// Of what the pixels at a and b show: the largest of albedo, normal and depth.
INLINE real feature_difference(Likeness l, uint a, uint b) {
    const real albedo = sum_of(square3(sub3(load_planes(l.albedo, a), load_planes(l.albedo, b))));
    const real normal = sum_of(square3(sub3(load_planes(l.normal, a), load_planes(l.normal, b))));
    const real depth = square(load_plane(l.depth, a) - load_plane(l.depth, b));
    return max_real(
        scaled_by(l.albedo_scale, a, b, albedo),
        max_real(scaled_by(l.normal_scale, a, b, normal), scaled_by(l.depth_scale, a, b, depth)));
}

#endif
