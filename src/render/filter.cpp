#include "render/filter.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace onde {

double filter_radius(Filter filter) {
    switch (filter) {
    case Filter::box:
        return 0.5;
    case Filter::tent:
        return 1.0;
    case Filter::gaussian:
    case Filter::blackman_harris:
        return 1.5;
    }
    return 0.5;
}

double filter_value(Filter filter, double offset) {
    const double radius = filter_radius(filter);
    if (std::abs(offset) > radius) return 0;
    switch (filter) {
    case Filter::box:
        return 1;
    case Filter::tent:
        return 1 - std::abs(offset);
    case Filter::gaussian:
        return std::exp(-offset * offset / (2 * 0.5 * 0.5));
    case Filter::blackman_harris: {
        const double a = std::numbers::pi * (offset / radius + 1);
        return 0.35875 - 0.48829 * std::cos(a) + 0.14128 * std::cos(2 * a) -
               0.01168 * std::cos(3 * a);
    }
    }
    return 1;
}

std::array<float, FILTER_TABLE_SIZE> filter_table(Filter filter) {
    constexpr int STEPS = 1 << 14;
    const double radius = filter_radius(filter), step = 2 * radius / STEPS;
    std::vector<double> cumulative(STEPS + 1);
    for (int i = 0; i < STEPS; i++)
        cumulative[size_t(i) + 1] =
            cumulative[size_t(i)] + filter_value(filter, -radius + (i + 0.5) * step);
    std::array<float, FILTER_TABLE_SIZE> table;
    size_t at = 0;
    for (size_t i = 0; i < table.size(); i++) {
        const double wanted = cumulative.back() * double(i) / double(table.size() - 1);
        while (at + 1 < STEPS && cumulative[at + 1] < wanted) at++;
        const double inside = (wanted - cumulative[at]) / (cumulative[at + 1] - cumulative[at]);
        table[i] = float(-radius + (double(at) + std::min(inside, 1.0)) * step);
    }
    return table;
}

} // namespace onde
