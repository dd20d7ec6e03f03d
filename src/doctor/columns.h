// Inputs for probes, and comparisons of their outputs that name the worst item.
#pragma once

#include "doctor/probe.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <cmath>
#include <random>

namespace onde::doctor {

using Column = std::vector<float>;
using Generator = std::mt19937;

/// 24 bits in [0, 1), the same on every machine.
inline float unit(Generator& generator) {
    return float(generator() >> 8) * 0x1p-24f;
}
inline Column uniform_column(Generator& generator, size_t count, float low = 0, float high = 1) {
    Column column(count);
    for (float& a : column) a = low + (high - low) * unit(generator);
    return column;
}
inline Column constant_column(size_t count, float value) {
    return Column(count, value);
}
inline Column word_column(size_t count, uint32_t value) {
    return Column(count, word(value));
}
inline glm::vec3 unit_vector(Generator& generator) {
    const double z = 1 - 2 * double(unit(generator)), a = 2 * M_PI * double(unit(generator));
    const double r = std::sqrt(1 - z * z);
    return glm::vec3(r * std::cos(a), r * std::sin(a), z);
}

/// Appends vectors as three columns.
inline void add_vectors(Columns& columns, const std::vector<glm::vec3>& vectors) {
    for (uint32_t k = 0; k < 3; k++) {
        Column column;
        for (const glm::vec3& v : vectors) column.push_back(v[k]);
        columns.push_back(std::move(column));
    }
}
inline std::vector<glm::vec3> unit_vectors(Generator& generator, size_t count) {
    std::vector<glm::vec3> vectors(count);
    for (glm::vec3& v : vectors) v = unit_vector(generator);
    return vectors;
}
inline glm::dvec3 vector_at(const Columns& columns, size_t k, size_t i) {
    return {columns[k][i], columns[k + 1][i], columns[k + 2][i]};
}

/// The item where `error(i)` exceeds `bound` the most, with the two values that `describe(i)`
/// gives; empty when there is none. NaN exceeds every bound.
template <class Error, class Describe>
std::string worst_item(size_t count, double bound, const Error& error, const Describe& describe) {
    size_t worst = count;
    double largest = bound;
    for (size_t i = 0; i < count; i++) {
        const double e = error(i);
        if (e <= largest) continue;
        worst = i;
        if (std::isnan(e)) break;
        largest = e;
    }
    if (worst == count) return {};
    return fmt::format("item {}: {} (error {:.3g}, bound {:.3g})", worst, describe(worst),
                       error(worst), bound);
}

/// Compares got[i] with wanted(i); empty when all differ by at most `bound`.
template <class Wanted>
std::string worst_difference(const Column& got, const Wanted& wanted, double bound) {
    return worst_item(
        got.size(), bound, [&](size_t i) { return std::abs(double(got[i]) - double(wanted(i))); },
        [&](size_t i) { return fmt::format("{} instead of {}", got[i], wanted(i)); });
}
/// The same, in proportion to the larger of wanted(i) and `floor`.
template <class Wanted>
std::string worst_ratio(const Column& got, const Wanted& wanted, double bound,
                        double floor = 1e-6) {
    return worst_item(
        got.size(), bound,
        [&](size_t i) {
            const double want = wanted(i);
            return std::abs(double(got[i]) - want) / std::max(std::abs(want), floor);
        },
        [&](size_t i) { return fmt::format("{} instead of {}", got[i], wanted(i)); });
}

/// The first item whose bits differ in a column; empty when there is none. NaNs are alike. Only
/// the items whose `live` word is not zero count, where there is such a column.
inline std::string first_bit_difference(const Columns& got, const Columns& wanted,
                                        const Column& live = {}) {
    for (size_t k = 0; k < wanted.size(); k++)
        for (size_t i = 0; i < wanted[k].size(); i++) {
            if (!live.empty() && live[i] == 0) continue;
            const float a = got[k][i], b = wanted[k][i];
            if (from_word(a) == from_word(b) || (std::isnan(a) && std::isnan(b))) continue;
            return fmt::format("item {}, word {}: {} ({:#x}) instead of {} ({:#x})", i, k, a,
                               from_word(a), b, from_word(b));
        }
    return {};
}

} // namespace onde::doctor
