// Planes of floats around a place, which is the number of a float in the first of them.
#ifndef ONDE_DENOISE_PLANES_H
#define ONDE_DENOISE_PLANES_H

#include "math/elementary.h"
#include "shared/denoise.h"

typedef struct {
    __global const float* first;
    uint stride, plane;
} Planes;

INLINE Planes planes_at(__global const DenoiseBand* band, __global const float* first, uint plane) {
    Planes planes;
    planes.stride = band->stride;
    planes.plane = band->plane;
    planes.first = first + (size_t)plane * band->plane;
    return planes;
}

INLINE real load_plane(Planes planes, uint at) {
    return load_real(planes.first + at);
}
// Of three planes.
INLINE real3 load_planes(Planes planes, uint at) {
    __global const float* p = planes.first + at;
    return make3(load_real(p), load_real(p + planes.plane),
                 load_real(p + 2 * (size_t)planes.plane));
}
INLINE void store_planes(__global float* p, uint plane, real3 a) {
    store_real(p, a.x);
    store_real(p + plane, a.y);
    store_real(p + 2 * (size_t)plane, a.z);
}

INLINE real sum_of(real3 a) {
    return a.x + a.y + a.z;
}
INLINE real3 square3(real3 a) {
    return mul3(a, a);
}

// The columns of a row that a kernel works on, `margin` of them left out at either end: the kernel
// steps from the first while a whole vector is left.
#define FOR_COLUMNS(column, band, margin)                                                          \
    for (uint column = margin; column + ONDE_WIDTH + margin <= (band)->stride; column += ONDE_WIDTH)

#endif
