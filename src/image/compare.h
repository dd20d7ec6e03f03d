// How far apart two pictures are.
#pragma once

#include "image/image.h"

#include <array>
#include <cstdint>

namespace onde {

/// Where two pictures differ most.
struct WorstPixel {
    uint32_t x = 0;
    uint32_t y = 0;
    uint32_t channel = 0;
    float a = 0;
    float b = 0;
};

/// The distance of a picture `a` from a reference `b`. All figures are over samples (a channel of
/// a pixel); pixels where either picture holds NaN or Inf are counted and left
/// out. Where no pixel is left the figures are NaN, never a perfect match.
struct Metrics {
    double mean_a = 0;
    double mean_b = 0;
    double rmse = 0;         ///< root of the mean of (a - b)^2
    double relative_mse = 0; ///< mean of (a - b)^2 / (b^2 + 0.01), after Rousselle et al. 2011
    double psnr = 0;         ///< 20 log10(1 / rmse) dB: the peak is 1; infinite for equal pictures
    double max_error = 0;    ///< largest |a - b|
    WorstPixel worst;        ///< where max_error is, the first in reading order
    uint64_t pixels = 0;     ///< compared
    uint64_t non_finite_a = 0; ///< pixels of `a` with NaN or Inf
    uint64_t non_finite_b = 0;
};

/// Throws InputError unless width, height and channels agree.
Metrics compare(const Image& a, const Image& b);

/// What share of the samples of `a`, a mean of so many of a renderer's samples, lies no farther
/// from a reference than their noise explains: a two-sided Z-test of each with the `variance` of
/// one of them, at a level of 1 % for all pixels together (Sidak 1967). Variances below 1e-4 count
/// as that. Throws like compare.
double share_within_noise(const Image& a, const Image& b, const Image& variance, uint32_t samples);

/// |a - b| per sample, but alpha (the fourth channel) is 1, so that the difference can be seen; NaN
/// stays NaN. Throws like compare.
Image difference_image(const Image& a, const Image& b);

} // namespace onde
