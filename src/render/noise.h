// How sure a film is of its pixels, and which of them need further samples.
//
// A film with the AOV of halves knows two pictures of itself, each of one half of every block of
// samples. A half is as evenly spread as any 32 samples in a row are, so that half the difference
// of the two is as large as the error of all of them, or larger. Of one pixel that is a single
// throw: its square is averaged over the pixels around. Where light is found seldom, one half of a
// pixel may have some, and not the pixels around: it is not sure before its own halves agree too.
#pragma once

#include "render/film_contents.h"

#include <span>
#include <vector>

namespace onde {

/// The share of the pixels that may be off by more than the noise that is asked for.
inline constexpr double NOISY_SHARE = 0.05;

/// How bright a radiance appears where 1 is white: its square root, about as displays and eyes have
/// it; above white the shown error is half the relative one.
double shown(double radiance);

/// The sums of a film that its noise is told from, pixel by pixel.
struct NoiseSums {
    uint32_t width, height;
    std::span<const cl_float4> radiance, halves;

    size_t pixels() const { return radiance.size(); }
    /// The mean of the samples in the first halves of blocks, or in the second ones.
    float half(size_t pixel, uint32_t color, bool second) const;
    double samples(size_t pixel) const { return radiance[pixel].s[3]; }
};

/// Of each pixel the standard error of its colours, in radiance; 0 where there is no sample.
Image standard_error(const NoiseSums& sums);

/// What the noise of a film is judged by.
struct NoiseTarget {
    float error;    ///< in shown values, root mean square over the colours
    float exposure; ///< stops by which radiance is shown brighter
};

/// What is known of a film's noise.
class NoiseEstimate {
  public:
    NoiseEstimate(const NoiseSums& sums, const NoiseTarget& target);

    /// Whether a pixel is off by more than the target with a probability of NOISY_SHARE at most,
    /// for normal errors, and its halves agree as well as that.
    bool is_sure(size_t pixel) const { return needs_[pixel] <= 1; }
    /// How many times as many samples as it has the pixel needs, about.
    double need(size_t pixel) const { return needs_[pixel]; }
    /// The share of the pixels with samples that are off by more than the target, about.
    double share() const;

  private:
    std::vector<double> doubts_; ///< the probabilities
    std::vector<double> needs_;
    size_t sampled_ = 0;
};

} // namespace onde
