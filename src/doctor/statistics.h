// Pearson's chi-square test, histograms of directions to apply it to, and stratification.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace onde::doctor {

/// How probable it is that a chi-square variable of that many degrees of freedom is at least
/// `statistic`: the upper incomplete gamma function Q(degrees / 2, statistic / 2), by its series
/// or continued fraction (Abramowitz and Stegun, 6.5.29 and 6.5.31).
inline double chi_square_tail(double statistic, double degrees) {
    const double a = degrees / 2, x = statistic / 2;
    if (x <= 0) return 1;
    const double scale = std::exp(-x + a * std::log(x) - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double n = a + 1; term > sum * 1e-15; n++) sum += term *= x / n;
        return 1 - sum * scale;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
    for (int n = 1; n < 10000; n++) {
        const double numerator = -n * (n - a);
        b += 2;
        d = 1 / (numerator * d + b);
        c = b + numerator / c;
        fraction *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return fraction * scale;
}

/// Compares counts with what was expected; both add up to the same total. Small bins are merged
/// until 5 are expected in each. Empty when the deviation is more probable than `significance`, or
/// a sentence with the worst bin.
inline std::string chi_square_failure(const std::vector<double>& observed,
                                      const std::vector<double>& expected, double significance) {
    std::vector<size_t> order(expected.size());
    for (size_t i = 0; i < order.size(); i++) order[i] = i;
    std::ranges::sort(order, {}, [&](size_t i) { return expected[i]; });
    double statistic = 0, worst = -1, pool_observed = 0, pool_expected = 0;
    size_t worst_bin = 0, bins = 0;
    for (size_t i : order) {
        pool_observed += observed[i];
        pool_expected += expected[i];
        if (pool_expected < 5) continue;
        const double term = std::pow(pool_observed - pool_expected, 2) / pool_expected;
        statistic += term;
        bins++;
        if (term > worst) {
            worst = term;
            worst_bin = i;
        }
        pool_observed = pool_expected = 0;
    }
    if (bins < 2) return "too few expected counts for a test";
    const double p = chi_square_tail(statistic, double(bins - 1));
    if (p > significance) return {};
    return fmt::format(
        "chi-square {:.1f} over {} bins, p = {:.2g}; worst is bin {} with {} instead "
        "of {:.2f}",
        statistic, bins, p, worst_bin, observed[worst_bin], expected[worst_bin]);
}

/// Bins of the sphere by polar angle and azimuth, and one more for samples that gave no direction.
struct SphereBins {
    size_t polar = 40, around = 32;

    size_t size() const { return polar * around + 1; }
    size_t nowhere() const { return polar * around; }
    /// Of a direction, not necessarily unit.
    size_t find(double x, double y, double z) const {
        const double theta = std::atan2(std::hypot(x, y), z) / M_PI;
        double phi = std::atan2(y, x) / (2 * M_PI);
        if (phi < 0) phi += 1;
        const size_t row = std::min(size_t(theta * double(polar)), polar - 1);
        return row * around + std::min(size_t(phi * double(around)), around - 1);
    }
};

/// Pairs of numbers in [0, 1).
struct Points {
    std::vector<float> x, y;
};

/// The first of the elementary intervals of area 1 / count that does not hold one point of a
/// (0, 2)-sequence's 2^log2_count.
inline std::string find_uneven_interval(const Points& points, uint32_t log2_count) {
    const uint32_t count = 1u << log2_count;
    for (uint32_t a = 0; a <= log2_count; a++) {
        const uint32_t columns = 1u << a, rows = count / columns;
        std::vector<int> found(count);
        for (uint32_t i = 0; i < count; i++)
            found[std::min(uint32_t(points.y[i] * float(rows)), rows - 1) * columns +
                  std::min(uint32_t(points.x[i] * float(columns)), columns - 1)]++;
        for (uint32_t i = 0; i < count; i++)
            if (found[i] != 1)
                return fmt::format("{} points in interval ({}, {}) of {} x {}", found[i],
                                   i % columns, i / columns, columns, rows);
    }
    return {};
}

} // namespace onde::doctor
