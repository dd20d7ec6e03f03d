// What the kernels of kernels/denoise compute, in double precision, pixel by pixel from the
// definition.
#pragma once

#include "denoise/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace onde::test {

class PlainDenoiser {
  public:
    explicit PlainDenoiser(const NoisyPicture& noisy)
        : noisy_(noisy), width_(int(noisy.radiance.width)), height_(int(noisy.radiance.height)) {}

    std::array<double, 3> pixel(int x, int y) const {
        std::array<double, 3> sum{};
        double weights = 0;
        for (int dy = -7; dy <= 7; ++dy)
            for (int dx = -7; dx <= 7; ++dx) {
                const int qx = x + dx, qy = y + dy;
                if (qx < 0 || qy < 0 || qx >= width_ || qy >= height_) continue;
                const double weight = weight_of(x, y, dx, dy);
                weights += weight;
                for (int k = 0; k < 3; ++k) sum[size_t(k)] += weight * limited(qx, qy, k);
            }
        for (double& value : sum) value /= weights;
        return sum;
    }

  private:
    static int mirrored(int i, int count) {
        if (i < 0) i = -i;
        if (i >= count) i = 2 * count - 2 - i;
        return std::clamp(i, 0, count - 1);
    }
    double at(const Image& image, int x, int y, int k) const {
        return double(
            image.pixel(uint32_t(mirrored(x, width_)), uint32_t(mirrored(y, height_)))[size_t(k)]);
    }
    double sum(const Image& image, int x, int y) const {
        return at(image, x, y, 0) + at(image, x, y, 1) + at(image, x, y, 2);
    }

    /// What is left of a pixel that outshines the third brightest of its neighbours.
    double share(int x, int y) const {
        std::vector<double> around;
        for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx)
                if (dx != 0 || dy != 0) around.push_back(sum(noisy_.radiance, x + dx, y + dy));
        std::ranges::sort(around, std::greater());
        double deviation = 0;
        for (int k = 0; k < 3; ++k) deviation += std::sqrt(at(noisy_.variance, x, y, k));
        const double value = sum(noisy_.radiance, x, y);
        const double limit = std::max(std::min(value, 1.2 * around[2]), value - 2 * deviation);
        return limit < value ? limit / value : 1.0;
    }
    double limited(int x, int y, int k) const { return share(x, y) * at(noisy_.radiance, x, y, k); }
    double variance(int x, int y, int k) const {
        double all = 0;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const double part = share(x + dx, y + dy);
                all += part * part * at(noisy_.variance, x + dx, y + dy, k);
            }
        return all / 9;
    }

    double radiance_difference(int px, int py, int qx, int qy) const {
        double difference = 0, scale = 0;
        for (int k = 0; k < 3; ++k) {
            const double d = limited(px, py, k) - limited(qx, qy, k);
            const double p = variance(px, py, k), q = variance(qx, qy, k);
            difference += d * d - p - std::min(p, q);
            scale += p + std::min(10 * p, q);
        }
        return difference / (0.3 * scale + 1e-20);
    }

    double scale_of(const Image& image, double tolerance, int x, int y) const {
        double gradient = 0;
        for (int k = 0; k < int(image.channels); ++k) {
            const auto step = [&](int dx, int dy) {
                const double d = at(image, x + dx, y + dy, k) - at(image, x, y, k);
                return d * d;
            };
            gradient += std::min(step(1, 0), step(-1, 0)) + std::min(step(0, 1), step(0, -1));
        }
        return 1 / (0.36 * std::max(tolerance, gradient));
    }
    double feature_difference(const Image& image, double tolerance, double relative, int px, int py,
                              int qx, int qy) const {
        double difference = 0;
        for (int k = 0; k < int(image.channels); ++k)
            difference += std::pow(at(image, px, py, k) - at(image, qx, qy, k), 2);
        const auto scale = [&](int x, int y) {
            return scale_of(image, tolerance + relative * std::pow(at(image, x, y, 0), 2), x, y);
        };
        return difference * std::min(scale(px, py), scale(qx, qy));
    }

    double weight_of(int x, int y, int dx, int dy) const {
        if (dx == 0 && dy == 0) return 1;
        double patch = 0;
        for (int py = -1; py <= 1; ++py)
            for (int px = -1; px <= 1; ++px)
                patch += radiance_difference(x + px, y + py, x + px + dx, y + py + dy) / 9;
        const auto feature = [&](const Image& image, double tolerance, double relative) {
            return feature_difference(image, tolerance, relative, x, y, x + dx, y + dy);
        };
        return std::exp(
            -std::max({patch, 0.0, feature(noisy_.albedo, 1e-3, 0), feature(noisy_.normal, 1e-2, 0),
                       feature(noisy_.depth, 1e-30, 1e-3)}));
    }

    const NoisyPicture& noisy_;
    int width_, height_;
};

} // namespace onde::test
