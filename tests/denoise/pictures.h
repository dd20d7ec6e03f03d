// Pictures with noise of a known kind, for the tests of denoisers.
#pragma once

#include "denoise/picture.h"

#include <cmath>
#include <cstdint>
#include <functional>

namespace onde::test {

/// A fixed sequence of numbers in [0, 1).
class Numbers {
  public:
    float next() {
        state_ = state_ * 1664525u + 1013904223u;
        return float(state_ >> 8) / 16777216.0f;
    }

  private:
    uint32_t state_ = 1;
};

/// Nothing but one surface, seen straight from the front.
inline NoisyPicture black_picture(uint32_t width, uint32_t height) {
    NoisyPicture picture{Image(width, height, 3), Image(width, height, 3), Image(width, height, 3),
                         Image(width, height, 3), Image(width, height, 1)};
    for (size_t i = 0; i < picture.depth.pixels.size(); ++i) {
        picture.normal.pixels[3 * i + 2] = 1;
        picture.depth.pixels[i] = 5;
        for (size_t k = 0; k < 3; ++k) picture.albedo.pixels[3 * i + k] = 0.5f;
    }
    return picture;
}

/// The mean of `samples` exponential numbers with mean 1, and the variance of that mean as the
/// numbers tell it.
struct NoisyNumber {
    float mean, variance;
};
inline NoisyNumber noisy_number(Numbers& numbers, int samples) {
    double sum = 0, squares = 0;
    for (int i = 0; i < samples; ++i) {
        const double x = -std::log(1 - 0.999999 * double(numbers.next()));
        sum += x;
        squares += x * x;
    }
    const double n = samples;
    return {float(sum / n), float((squares - sum * sum / n) / (n * (n - 1)))};
}

/// Light of `mean` at each pixel and channel, times such a number of 16 samples.
inline NoisyPicture
noisy_picture(uint32_t width, uint32_t height,
              const std::function<float(uint32_t x, uint32_t y, size_t channel)>& mean) {
    NoisyPicture picture = black_picture(width, height);
    Numbers numbers;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const NoisyNumber number = noisy_number(numbers, 16);
            for (size_t k = 0; k < 3; ++k) {
                const float light = mean(x, y, k);
                picture.radiance.pixel(x, y)[k] = light * number.mean;
                picture.variance.pixel(x, y)[k] = light * light * number.variance;
            }
        }
    return picture;
}

/// Of the columns from `first` to before `end`, and all rows and channels.
inline double mean_of(const Image& image, uint32_t first, uint32_t end) {
    double sum = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = first; x < end; ++x)
            for (float value : image.pixel(x, y)) sum += double(value);
    return sum / (double(image.height) * (end - first) * image.channels);
}

} // namespace onde::test
