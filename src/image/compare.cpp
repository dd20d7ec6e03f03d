#include "image/compare.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace onde {

static void check_same_shape(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height || a.channels != b.channels)
        throw InputError("the pictures differ in shape, {} x {} with {} channels against {} x {} "
                         "with {}; compare pictures of one size and kind",
                         a.width, a.height, a.channels, b.width, b.height, b.channels);
}

static bool is_finite(std::span<const float> pixel) {
    return std::all_of(pixel.begin(), pixel.end(),
                       [](float value) { return std::isfinite(value); });
}

namespace {

/// Sums of squares over the samples seen so far.
struct Sums {
    double a = 0, b = 0, squared = 0, relative = 0;

    void add(double value, double reference) {
        const double error = value - reference;
        a += value;
        b += reference;
        squared += error * error;
        relative += error * error / (reference * reference + 0.01);
    }
};

} // namespace

static void keep_worst(Metrics& metrics, const WorstPixel& candidate) {
    const double error = std::abs(double(candidate.a) - double(candidate.b));
    if (error <= metrics.max_error) return;
    metrics.max_error = error;
    metrics.worst = candidate;
}

/// Without a pixel every mean is 0 / 0, as it should be.
static void finish(Metrics& metrics, const Sums& sums, uint32_t channels) {
    const double samples = double(metrics.pixels) * channels;
    metrics.mean_a = sums.a / samples;
    metrics.mean_b = sums.b / samples;
    metrics.rmse = std::sqrt(sums.squared / samples);
    metrics.relative_mse = sums.relative / samples;
    metrics.psnr = -20 * std::log10(metrics.rmse);
    if (metrics.pixels == 0) metrics.max_error = std::nan("");
}

Metrics compare(const Image& a, const Image& b) {
    check_same_shape(a, b);
    Metrics metrics;
    Sums sums;
    for (uint32_t y = 0; y < a.height; ++y)
        for (uint32_t x = 0; x < a.width; ++x) {
            const auto left = a.pixel(x, y), right = b.pixel(x, y);
            const bool finite_left = is_finite(left), finite_right = is_finite(right);
            metrics.non_finite_a += !finite_left;
            metrics.non_finite_b += !finite_right;
            if (!finite_left || !finite_right) continue;
            ++metrics.pixels;
            for (uint32_t channel = 0; channel < a.channels; ++channel) {
                sums.add(left[channel], right[channel]);
                keep_worst(metrics, {x, y, channel, left[channel], right[channel]});
            }
        }
    finish(metrics, sums, a.channels);
    return metrics;
}

double share_within_noise(const Image& a, const Image& b, const Image& variance, uint32_t samples) {
    constexpr double LEVEL = 0.01, LEAST_VARIANCE = 1e-4;
    check_same_shape(a, b);
    check_same_shape(b, variance);
    const double pixels = double(a.width) * a.height;
    const double level = 1.0 - std::pow(1.0 - LEVEL, 1.0 / pixels);
    size_t within = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const double error = std::abs(double(a.pixels[i]) - double(b.pixels[i]));
        const double deviation =
            std::sqrt(std::max(double(variance.pixels[i]), LEAST_VARIANCE) / samples);
        within += std::erfc(error / deviation / std::sqrt(2.0)) > level;
    }
    return double(within) / double(a.pixels.size());
}

Image difference_image(const Image& a, const Image& b) {
    check_same_shape(a, b);
    Image difference(a.width, a.height, a.channels);
    std::transform(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), difference.pixels.begin(),
                   [](float left, float right) { return std::abs(left - right); });
    if (a.channels == 4)
        for (size_t i = 3; i < difference.pixels.size(); i += 4) difference.pixels[i] = 1;
    return difference;
}

} // namespace onde
