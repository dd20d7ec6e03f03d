// The kernel that takes from a picture what stands out of it: a pixel that is brighter than its
// surroundings by more than its samples can tell.
#include "denoise/planes.h"

// What a pixel may exceed the third brightest of its 24 neighbours by.
#define BRIGHTER 1.2f
// Standard deviations by which a pixel may be taken to be too bright.
#define DOUBTED 2.0f

// The three largest values so far.
typedef struct {
    real first, second, third;
} Largest;

INLINE Largest add_value(Largest l, real value) {
    l.third = max_real(l.third, min_real(l.second, value));
    l.second = max_real(l.second, min_real(l.first, value));
    l.first = max_real(l.first, value);
    return l;
}

INLINE real third_largest_around(Planes radiance, uint at) {
    Largest l;
    l.first = l.second = l.third = (real)(0.0f);
    for (int dy = -2; dy <= 2; dy++)
        for (int dx = -2; dx <= 2; dx++)
            if (dx != 0 || dy != 0)
                l = add_value(l,
                              sum_of(load_planes(radiance, at + dy * (int)radiance.stride + dx)));
    return l.third;
}

INLINE real deviation(real3 variance) {
    return sqrt(variance.x) + sqrt(variance.y) + sqrt(variance.z);
}

// What is left of a pixel's radiance, in [0, 1].
INLINE real share_left(real value, real around, real3 variance) {
    const real least = value - DOUBTED * deviation(variance);
    const real limit = max_real(min_real(value, BRIGHTER * around), least);
    return choose(limit < value, limit / value, (real)(1.0f));
}

// `count` rows; the first and last two have no value.
__kernel void limit(uint count, __global const DenoiseBand* band, __global const float* noisy,
                    __global float* limited) {
    const uint row = get_global_id(0);
    if (row < 2 || row + 2 >= count) return;
    const Planes radiance = planes_at(band, noisy, NOISY_RADIANCE);
    const Planes variance = planes_at(band, noisy, NOISY_VARIANCE);
    FOR_COLUMNS(column, band, 2) {
        const uint at = row * band->stride + column;
        const real3 value = load_planes(radiance, at), doubt = load_planes(variance, at);
        const real share = share_left(sum_of(value), third_largest_around(radiance, at), doubt);
        store_planes(limited + at, band->plane, scale3(value, share));
        store_planes(limited + (size_t)LIMITED_VARIANCE * band->plane + at, band->plane,
                     scale3(doubt, share * share));
        store_real(limited + (size_t)LIMITED_SHARE * band->plane + at, share);
    }
}
