// Bounding volumes as they lie in device memory. Plain data for C++ and OpenCL C alike.
#ifndef ONDE_SHARED_VOLUMES_H
#define ONDE_SHARED_VOLUMES_H

#include "shared/types.h"

#define FEW_SLABS 7   // the axes and the four diagonals of a cube: 14 faces
#define MANY_SLABS 13 // and the six diagonals of its faces: 26 faces

// `reach` is the largest |x| + |y| + |z| of a point inside, or more; rounding grows with it.

// Two corners.
typedef struct {
    float low[3], high[3];
    float reach;
    uint unused;
} BoxVolume;

// Three axes, about orthonormal, one after the other, and what the object covers along each.
typedef struct {
    float axes[9];
    float low[3], high[3];
    float reach;
} OrientedBoxVolume;

// A discrete oriented polytope: what the object covers along x; y; z; x+y+z; x+y-z; x-y+z; -x+y+z;
// x+y; x-y; x+z; x-z; y+z; y-z.
typedef struct {
    float low[MANY_SLABS], high[MANY_SLABS];
    float reach;
    uint unused;
} SlabsVolume;

typedef struct {
    float center[3];
    float radius;
} SphereVolume;

#endif
