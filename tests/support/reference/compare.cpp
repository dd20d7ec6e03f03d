#include "support/reference/compare.h"

#include "core/error.h"
#include "support/reference/sampling.h"

#include <algorithm>

namespace onde {
namespace {

constexpr uint32_t BLOCK = 8;
constexpr double EXPECTED_OUTLIERS = 0.01;
constexpr double SIGMAS = 4.0;
/// Single precision sums on both sides: their relative error, beside the statistical one.
constexpr double ROUNDING = 1e-5;

struct Sums {
    double device = 0.0, reference = 0.0, variance = 0.0;
    uint32_t pixels = 0;

    void add(const Sums& other) {
        device += other.device;
        reference += other.reference;
        variance += other.variance;
        pixels += other.pixels;
    }
    double z() const {
        const double rounding = ROUNDING * (std::abs(device) + std::abs(reference));
        const double deviation = std::sqrt(variance + rounding * rounding);
        return deviation == 0.0 ? 0.0 : (device - reference) / deviation;
    }
};

struct Worst {
    double z = 0.0;
    uint32_t x = 0, y = 0;
    Sums sums;
};

// Channels are taken as fully correlated, which they nearly are and which bounds the variance.
double luminance_variance(const glm::vec3& variance) {
    const double deviation = reference::luminance(glm::sqrt(variance));
    return deviation * deviation;
}

Sums pixel_sums(const Image& device, double device_share, const ReferenceResult& reference,
                uint32_t x, uint32_t y) {
    const std::span<const float> p = device.pixel(x, y);
    const size_t i = size_t(y) * reference.width + x;
    return {reference::luminance({p[0], p[1], p[2]}), reference::luminance(reference.mean[i]),
            luminance_variance(reference.variance_of_mean[i]) * (1.0 + device_share), 1};
}

void check(const Image& device, uint32_t device_samples, const ReferenceResult& reference) {
    if (device.width != reference.width || device.height != reference.height || device.channels < 3)
        throw InputError("A picture of {}x{} pixels and {} channels cannot be compared to a "
                         "reference of {}x{} and 3.",
                         device.width, device.height, device.channels, reference.width,
                         reference.height);
    if (device_samples == 0 || reference.samples < 2)
        throw InputError("{} samples against {} of the reference say nothing of variance: take at "
                         "least 1 and 2.",
                         device_samples, reference.samples);
}

} // namespace

Comparison compare_to_reference(const Image& device, uint32_t device_samples,
                                const ReferenceResult& reference) {
    check(device, device_samples, reference);
    const double share = double(reference.samples) / device_samples;
    Comparison c;
    Sums whole;
    Worst worst;
    uint32_t outliers = 0;
    for (uint32_t top = 0; top < device.height; top += BLOCK)
        for (uint32_t left = 0; left < device.width; left += BLOCK) {
            Sums block;
            for (uint32_t y = top; y < std::min(top + BLOCK, device.height); ++y)
                for (uint32_t x = left; x < std::min(left + BLOCK, device.width); ++x)
                    block.add(pixel_sums(device, share, reference, x, y));
            const double z = block.z();
            ++c.blocks;
            outliers += !(std::abs(z) <= 3.0); // NaN is one as well, and the worst of all
            if (!std::isnan(worst.z) && !(std::abs(z) <= std::abs(worst.z)))
                worst = {z, left, top, block};
            whole.add(block);
        }
    const double n = c.blocks, p = EXPECTED_OUTLIERS;
    c.outlier_fraction = outliers / n;
    c.outlier_bound = p + SIGMAS * std::sqrt(p * (1.0 - p) / n) + 1.0 / n;
    c.mean_z = whole.z();
    c.worst_z = worst.z;
    c.accepted = c.outlier_fraction <= c.outlier_bound && std::abs(c.mean_z) <= SIGMAS;
    const double pixels = std::max(worst.sums.pixels, 1u);
    c.sentence = fmt::format(
        "{}: {} of {} blocks beyond 3 sigma ({:.2f}%, at most {:.2f}%), image means {:.6g} and "
        "{:.6g} (z {:+.2f}), worst block at pixel ({}, {}) with {:.6g} against {:.6g} (z {:+.2f}).",
        c.accepted ? "Agrees with the reference" : "Differs from the reference", outliers, c.blocks,
        100.0 * c.outlier_fraction, 100.0 * c.outlier_bound, whole.device / whole.pixels,
        whole.reference / whole.pixels, c.mean_z, worst.x, worst.y, worst.sums.device / pixels,
        worst.sums.reference / pixels, worst.z);
    return c;
}

} // namespace onde
