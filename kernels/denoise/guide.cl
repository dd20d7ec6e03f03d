// The kernel that prepares what pixels are compared by: the variance of their surroundings, and how
// much albedo, normal and depth may differ where they change anyway.
#include "denoise/planes.h"

// Squares of differences that are always tolerated; of depth, relative to it.
#define ALBEDO_TOLERANCE 1e-3f
#define NORMAL_TOLERANCE 1e-2f
#define DEPTH_TOLERANCE 1e-3f
// 1 / 0.6^2: of the tolerance, what makes one step of exp(-x).
#define FEATURE_SCALE 2.7777778f

// The mean of 3 x 3 pixels.
INLINE real3 mean_around(Planes planes, uint at) {
    real3 sum = zero3();
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++)
            sum = add3(sum, load_planes(planes, at + dy * (int)planes.stride + dx));
    return scale3(sum, (real)(1.0f / 9.0f));
}

// The square of a plane's gradient, by the smaller difference along each axis.
INLINE real gradient(Planes p, uint at) {
    const real here = load_plane(p, at);
    const real x =
        min_real(square(load_plane(p, at + 1) - here), square(here - load_plane(p, at - 1)));
    const real y = min_real(square(load_plane(p, at + p.stride) - here),
                            square(here - load_plane(p, at - p.stride)));
    return x + y;
}
INLINE real gradient_of_three(__global const DenoiseBand* band, __global const float* noisy,
                              uint plane, uint at) {
    return gradient(planes_at(band, noisy, plane), at) +
           gradient(planes_at(band, noisy, plane + 1), at) +
           gradient(planes_at(band, noisy, plane + 2), at);
}

INLINE real inverse_of(real tolerance, real gradient_squared) {
    return FEATURE_SCALE / max_real(gradient_squared, tolerance);
}

// `count` rows; the first and last three have no value.
__kernel void guide(uint count, __global const DenoiseBand* band, __global const float* noisy,
                    __global const float* limited, __global float* guides) {
    const uint row = get_global_id(0);
    if (row < 3 || row + 3 >= count) return;
    const Planes variance = planes_at(band, limited, LIMITED_VARIANCE);
    const Planes depth = planes_at(band, noisy, NOISY_DEPTH);
    FOR_COLUMNS(column, band, 3) {
        const uint at = row * band->stride + column;
        __global float* out = guides + at;
        store_planes(out, band->plane, mean_around(variance, at));
        store_real(
            out + (size_t)GUIDE_ALBEDO * band->plane,
            inverse_of((real)(ALBEDO_TOLERANCE), gradient_of_three(band, noisy, NOISY_ALBEDO, at)));
        store_real(
            out + (size_t)GUIDE_NORMAL * band->plane,
            inverse_of((real)(NORMAL_TOLERANCE), gradient_of_three(band, noisy, NOISY_NORMAL, at)));
        const real far = DEPTH_TOLERANCE * square(load_plane(depth, at)) + 1e-30f;
        store_real(out + (size_t)GUIDE_DEPTH * band->plane, inverse_of(far, gradient(depth, at)));
    }
}
