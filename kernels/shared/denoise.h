// A band of a picture that is denoised, as planes of floats that host and kernels agree on.
#ifndef ONDE_SHARED_DENOISE_H
#define ONDE_SHARED_DENOISE_H

#include "shared/types.h"

// Around a band lie as many rows, and before and behind each of its rows as many columns: of the
// picture, or beyond its edges mirrored. Kernels read vectors of 16 from any of them.
#define DENOISE_ROWS_AROUND 12
#define DENOISE_COLUMNS_BEFORE 16
#define DENOISE_COLUMNS_BEHIND 32

// Pixels to either side among which a pixel's like are searched.
#define DENOISE_RADIUS 7

// A row's columns are rounded up to a multiple of this, of which tiles take a part.
#define DENOISE_COLUMNS 32

// What a picture brings. Three planes each but of depth.
#define NOISY_RADIANCE 0
#define NOISY_VARIANCE 3
#define NOISY_ALBEDO 6
#define NOISY_NORMAL 9
#define NOISY_DEPTH 12
#define NOISY_PLANES 13

// Without outliers: radiance, its variance, and what was left of the radiance as a share.
#define LIMITED_RADIANCE 0
#define LIMITED_VARIANCE 3
#define LIMITED_SHARE 6
#define LIMITED_PLANES 7

// What pixels are compared by beside that: the variance of a neighbourhood, and the inverse squares
// of the differences that are tolerated.
#define GUIDE_VARIANCE 0
#define GUIDE_ALBEDO 3
#define GUIDE_NORMAL 4
#define GUIDE_DEPTH 5
#define GUIDE_PLANES 6

// The mean of pixels that are alike, and its variance, three planes each.
#define AVERAGE_RADIANCE 0
#define AVERAGE_VARIANCE 3
#define AVERAGE_PLANES 6

// Of a band: rows `first_row` to `first_row + rows - 1` of a picture. A plane has `stride` floats a
// row and `plane` floats in all.
typedef struct {
    uint width, height; // of the picture
    uint first_row, rows;
    uint stride, plane;
} DenoiseBand;

#endif
