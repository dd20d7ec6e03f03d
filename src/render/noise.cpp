#include "render/noise.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace onde {
namespace {

/// Squares are averaged over the pixels that are no further away, in x and in y.
constexpr uint32_t REACH = 2;

/// Standard errors beyond which a share of NOISY_SHARE of normal errors lies.
constexpr double SURE = 1.959963984540054;

/// Of a row of numbers: those within REACH of each, added up one by one, so that a large one leaves
/// nothing behind.
void add_up_row(const double* from, size_t step, size_t count, double* to) {
    for (size_t i = 0; i < count; i++) {
        double sum = 0;
        const size_t end = std::min(i + REACH + 1, count);
        for (size_t k = i - std::min<size_t>(i, REACH); k < end; k++) sum += from[k * step];
        to[i * step] = sum;
    }
}

/// The sums over the pixels around each.
std::vector<double> add_up(const std::vector<double>& values, uint32_t width, uint32_t height) {
    std::vector<double> rows(values.size()), all(values.size());
    for (uint32_t y = 0; y < height; y++)
        add_up_row(&values[size_t(y) * width], 1, width, &rows[size_t(y) * width]);
    for (uint32_t x = 0; x < width; x++) add_up_row(&rows[x], width, height, &all[x]);
    return all;
}

/// The averages over the samples around each pixel: `values` and `weights` by pixel, weights of 0
/// where there is none.
std::vector<double> average(const std::vector<double>& values, const std::vector<double>& weights,
                            uint32_t width, uint32_t height) {
    std::vector<double> sums = add_up(values, width, height);
    const std::vector<double> all = add_up(weights, width, height);
    for (size_t i = 0; i < sums.size(); i++) sums[i] = all[i] > 0 ? sums[i] / all[i] : 0;
    return sums;
}

double square(double value) {
    return value * value;
}

/// Half the difference of two halves, squared, as of one sample.
double squared_error(double a, double b, double samples) {
    return square(0.5 * (a - b)) * samples;
}

} // namespace

double shown(double radiance) {
    if (!(radiance > 0)) return 0;
    return radiance < 1 ? std::sqrt(radiance) : 1 + 0.5 * std::log(radiance);
}

float NoiseSums::half(size_t pixel, uint32_t color, bool second) const {
    const cl_float4 &all = radiance[pixel], &part = halves[pixel];
    const float count = second ? part.s[3] : all.s[3] - part.s[3];
    const float sum = second ? part.s[color] : all.s[color] - part.s[color];
    return count > 0 ? sum / count : 0;
}

Image standard_error(const NoiseSums& sums) {
    Image image(sums.width, sums.height, 3);
    std::vector<double> weights(sums.pixels()), squares(sums.pixels());
    for (size_t i = 0; i < sums.pixels(); i++) weights[i] = sums.samples(i) > 0;
    for (uint32_t color = 0; color < 3; color++) {
        for (size_t i = 0; i < sums.pixels(); i++)
            squares[i] = squared_error(sums.half(i, color, false), sums.half(i, color, true),
                                       sums.samples(i));
        const std::vector<double> of_sample = average(squares, weights, sums.width, sums.height);
        for (size_t i = 0; i < sums.pixels(); i++)
            if (weights[i] > 0)
                image.pixels[3 * i + color] = float(std::sqrt(of_sample[i] / sums.samples(i)));
    }
    return image;
}

NoiseEstimate::NoiseEstimate(const NoiseSums& sums, const NoiseTarget& target)
    : doubts_(sums.pixels()), needs_(sums.pixels()) {
    const double scale = std::exp2(double(target.exposure));
    std::vector<double> weights(sums.pixels()), squares(sums.pixels());
    for (size_t i = 0; i < sums.pixels(); i++) {
        weights[i] = sums.samples(i) > 0;
        for (uint32_t color = 0; color < 3; color++)
            squares[i] += squared_error(shown(scale * sums.half(i, color, false)),
                                        shown(scale * sums.half(i, color, true)), sums.samples(i)) /
                          3;
    }
    const std::vector<double> of_sample = average(squares, weights, sums.width, sums.height);
    for (size_t i = 0; i < sums.pixels(); i++) {
        if (weights[i] == 0) continue;
        const double variance = of_sample[i] / sums.samples(i);
        const double own = squares[i] / sums.samples(i);
        doubts_[i] = std::erfc(target.error / std::sqrt(2 * variance));
        needs_[i] = std::max(variance * SURE * SURE, own) / square(target.error);
        sampled_++;
    }
}

double NoiseEstimate::share() const {
    const double all = std::accumulate(doubts_.begin(), doubts_.end(), 0.0);
    return sampled_ > 0 ? all / double(sampled_) : 0;
}

} // namespace onde
