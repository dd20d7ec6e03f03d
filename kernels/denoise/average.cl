// The kernel that denoises: each pixel becomes the mean of those around it, weighted by how like
// they are in 3 x 3 pixels about each. A work item has a tile of pixels and goes over all offsets
// for it, so that a difference of two pixels is computed once for all patches that it is in. The
// size of tiles changes no bit: a pixel's sum goes over the offsets in their order.
#include "denoise/likeness.h"

#ifndef ONDE_TILE_COLUMNS
    #define ONDE_TILE_COLUMNS 32
#endif
#ifndef ONDE_TILE_ROWS
    #define ONDE_TILE_ROWS 16
#endif

#define LOG2_E 1.44269504f

// Differences along a row of a tile, one column more at either end, in whole vectors.
#define PATCH_COLUMNS (ONDE_TILE_COLUMNS + 2 + ONDE_WIDTH)

typedef struct {
    uint column, row; // of its first pixel, in the band
    uint at;
} Tile;

// The sums over three columns of the differences in a row of the tile.
INLINE void add_columns(Likeness likeness, uint at, int offset, float* sums) {
    float differences[PATCH_COLUMNS];
    for (uint k = 0; k < ONDE_TILE_COLUMNS + 2; k += ONDE_WIDTH)
        spill_real(differences + k, radiance_difference(likeness, at + k - 1, at + k - 1 + offset));
    for (uint k = 0; k < ONDE_TILE_COLUMNS; k += ONDE_WIDTH)
        spill_real(sums + k, unspill_real(differences + k) + unspill_real(differences + k + 1) +
                                 unspill_real(differences + k + 2));
}

// 1 of the lanes from x on that lie in the picture's width, 0 beside it.
INLINE real inside(int x, uint width) {
    const natural column = lane_index() + (uint)x; // of negative x, far beyond
    return choose(column < width, (real)(1.0f), (real)(0.0f));
}

INLINE real weight_of(Likeness likeness, uint at, int offset, real patch) {
    if (offset == 0) return (real)(1.0f);
    const real difference = max_real(max_real(patch * (1.0f / 9.0f), (real)(0.0f)),
                                     feature_difference(likeness, at, at + offset));
    return exp2_real(difference * -LOG2_E);
}

// What is averaged: `target` as far as it was left, with its variance.
typedef struct {
    Planes radiance, share, variance;
} Averaged;

// Per vector of pixels: weighted red, green and blue, weight, and their variances.
#define TILE_SUMS 7

INLINE void add_sum(float* sum, real a) {
    spill_real(sum, unspill_real(sum) + a);
}
INLINE void add_weighted(Averaged averaged, uint at, real weight, float* sums) {
    const real3 radiance =
        scale3(load_planes(averaged.radiance, at), weight * load_plane(averaged.share, at));
    const real3 variance = scale3(load_planes(averaged.variance, at), weight * weight);
    add_sum(sums, radiance.x);
    add_sum(sums + ONDE_WIDTH, radiance.y);
    add_sum(sums + 2 * ONDE_WIDTH, radiance.z);
    add_sum(sums + 3 * ONDE_WIDTH, weight);
    add_sum(sums + 4 * ONDE_WIDTH, variance.x);
    add_sum(sums + 5 * ONDE_WIDTH, variance.y);
    add_sum(sums + 6 * ONDE_WIDTH, variance.z);
}

// Adds one offset to the sums of a tile.
INLINE void add_offset(__global const DenoiseBand* band, Likeness likeness, Averaged averaged,
                       Tile tile, int dx, int dy, float* sums) {
    const int offset = dy * (int)band->stride + dx;
    float columns[3][ONDE_TILE_COLUMNS];
    add_columns(likeness, tile.at - band->stride, offset, columns[0]);
    add_columns(likeness, tile.at, offset, columns[1]);
    for (uint row = 0; row < ONDE_TILE_ROWS; row++) {
        const uint start = tile.at + row * band->stride;
        add_columns(likeness, start + band->stride, offset, columns[(row + 2) % 3]);
        if (band->first_row + tile.row + row + (uint)dy >= band->height) continue;
        for (uint k = 0; k < ONDE_TILE_COLUMNS; k += ONDE_WIDTH) {
            const real patch = unspill_real(columns[row % 3] + k) +
                               unspill_real(columns[(row + 1) % 3] + k) +
                               unspill_real(columns[(row + 2) % 3] + k);
            const real weight = weight_of(likeness, start + k, offset, patch) *
                                inside((int)(tile.column + k) + dx, band->width);
            add_weighted(averaged, start + k + offset, weight,
                         sums + TILE_SUMS * (row * ONDE_TILE_COLUMNS + k));
        }
    }
}

INLINE void store_means(__global const DenoiseBand* band, Tile tile, const float* sums,
                        __global float* output) {
    for (uint row = 0; row < ONDE_TILE_ROWS && tile.row + row < band->rows; row++)
        for (uint k = 0; k < ONDE_TILE_COLUMNS; k += ONDE_WIDTH) {
            const float* sum = sums + TILE_SUMS * (row * ONDE_TILE_COLUMNS + k);
            const real weight = unspill_real(sum + 3 * ONDE_WIDTH), squared = weight * weight;
            __global float* to = output + tile.at + row * band->stride + k;
            for (uint i = 0; i < 3; i++) {
                store_real(to + (size_t)(AVERAGE_RADIANCE + i) * band->plane,
                           unspill_real(sum + i * ONDE_WIDTH) / weight);
                store_real(to + (size_t)(AVERAGE_VARIANCE + i) * band->plane,
                           unspill_real(sum + (4 + i) * ONDE_WIDTH) / squared);
            }
        }
}

// `count` tiles, `across` of them in a row. What is averaged is `target`, three planes that lie as
// the radiance: it, or a part of it. The variance is that of the whole.
__kernel void average(uint count, uint across, __global const DenoiseBand* band,
                      __global const float* noisy, __global const float* limited,
                      __global const float* guides, __global const float* target,
                      __global float* output) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    Tile tile;
    tile.column = item % across * ONDE_TILE_COLUMNS;
    tile.row = item / across * ONDE_TILE_ROWS;
    tile.at =
        (tile.row + DENOISE_ROWS_AROUND) * band->stride + tile.column + DENOISE_COLUMNS_BEFORE;
    const Likeness likeness = likeness_of(band, noisy, limited, guides);
    Averaged averaged;
    averaged.radiance = planes_at(band, target, 0);
    averaged.share = planes_at(band, limited, LIMITED_SHARE);
    averaged.variance = planes_at(band, limited, LIMITED_VARIANCE);
    float sums[TILE_SUMS * ONDE_TILE_ROWS * ONDE_TILE_COLUMNS];
    for (uint i = 0; i < TILE_SUMS * ONDE_TILE_ROWS * ONDE_TILE_COLUMNS; i++) sums[i] = 0.0f;
    for (int dy = -DENOISE_RADIUS; dy <= DENOISE_RADIUS; dy++)
        for (int dx = -DENOISE_RADIUS; dx <= DENOISE_RADIUS; dx++)
            add_offset(band, likeness, averaged, tile, dx, dy, sums);
    store_means(band, tile, sums, output);
}
