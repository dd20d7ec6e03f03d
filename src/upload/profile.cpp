#include "upload/profile.h"

#include "shared/profile.h"
#include "upload/alias_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace onde {
namespace {

constexpr double PI = std::numbers::pi;

/// Calls visit(cell's four nodes, solid angle over that of the sphere), row by row.
template <class Visit>
void for_each_cell(const LightProfile& p, const Visit& visit) {
    for (uint32_t row = 0; row < p.rows; row++) {
        const double height = std::cos(PI * row / p.rows) - std::cos(PI * (row + 1) / p.rows);
        for (uint32_t column = 0; column < p.columns; column++) {
            const std::array<float, 4> nodes{p.node(row, column), p.node(row, column + 1),
                                             p.node(row + 1, column), p.node(row + 1, column + 1)};
            visit(nodes, 0.5 * height / p.columns);
        }
    }
}

} // namespace

std::vector<uint32_t> pack_profile(const LightProfile& profile) {
    std::vector<uint32_t> words{profile.rows, profile.columns};
    for (const float candela : profile.candela)
        words.push_back(std::bit_cast<uint32_t>(float(double(candela) / LUMENS_PER_WATT)));
    // By the brightest corner, so that no direction with light is left out.
    std::vector<double> weights;
    for_each_cell(profile, [&](const auto& nodes, double share) {
        weights.push_back(double(*std::ranges::max_element(nodes)) * share);
    });
    for (const AliasEntry& entry : build_alias_table(weights)) {
        words.push_back(std::bit_cast<uint32_t>(entry.below));
        words.push_back(entry.alias);
        words.push_back(std::bit_cast<uint32_t>(entry.pmf));
    }
    return words;
}

double mean_of(const LightProfile& profile) {
    double sum = 0;
    for_each_cell(profile, [&](const auto& nodes, double share) {
        sum += share * 0.25 *
               (double(nodes[0]) + double(nodes[1]) + double(nodes[2]) + double(nodes[3]));
    });
    return sum / LUMENS_PER_WATT;
}

float opening_of(const LightProfile& profile) {
    for (uint32_t row = profile.rows; row > 0; row--)
        for (uint32_t column = 0; column < profile.columns; column++)
            if (profile.node(row - 1, column) > 0 || profile.node(row, column) > 0)
                return float(1 - std::cos(PI * row / profile.rows));
    return 0;
}

} // namespace onde
