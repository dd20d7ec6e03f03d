#include "upload/albedo_tables.h"

#include "upload/microfacet_albedo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace onde {
namespace {

/// Of row 0; smoother microfacets look the same but at grazing angles that no picture shows.
constexpr double LEAST_ALPHA = 1e-3;
constexpr double LEAST_COSINE = 1e-4;
/// The word of a mirror: kernels that serve other scenes too read tables that no material asked
/// for, and must not make NaN of them.
constexpr uint32_t NOTHING_LOST = 0x8000ffff;
/// Tables of glass take some 10 ms each.
constexpr size_t MOST_GLASS_TABLES = 64;

/// The cosine of a place in a row: ALBEDO_PLACE the other way.
double cosine_at(uint32_t column, uint32_t columns, double alpha) {
    const double place = double(column) / (columns - 1) / (1 + alpha);
    return std::clamp(place < 1 ? alpha * place / (1 - place) : 1.0, LEAST_COSINE, 1.0);
}

double schlick_weight(double cosine) {
    const double m = 1 - cosine;
    return m * m * (m * m) * m;
}

double alpha_of(uint32_t row) {
    const double roughness = double(row) / (ALBEDO_ROWS - 1);
    return std::max(roughness * roughness, LEAST_ALPHA);
}

uint32_t half_word(double number) {
    return uint32_t(std::lround(std::clamp(number, 0.0, 1.0) * 65535));
}
uint32_t word_of_two(AlbedoNumbers n) {
    return half_word(n.first) | half_word(n.second) << 16;
}

/// A place between two entries of a row of `count`.
struct Between {
    uint32_t first;
    double fraction;
};
Between between(double place, uint32_t count) {
    const double scaled = place * (count - 1);
    const double whole = std::min(std::floor(scaled), double(count - 2));
    return {uint32_t(whole), scaled - whole};
}

AlbedoNumbers mix(std::span<const uint32_t> words, uint32_t i, uint32_t step, double t) {
    const auto number = [&](uint32_t at, uint32_t shift) {
        return double(words[at] >> shift & 0xffff) / 65535;
    };
    return {std::lerp(number(i, 0), number(i + step, 0), t),
            std::lerp(number(i, 16), number(i + step, 16), t)};
}

constexpr auto AS_THEY_ARE = [](AlbedoNumbers n, double) { return n; };

/// Fills a table by number(cosine, alpha). placed: the alpha of the places in its rows, where that
/// is not their own. counted(numbers, cosine): those of a place, of which the means are.
template <class Number, class Counted>
void fill_table(std::span<uint32_t> table, const Number& number, const Counted& counted,
                std::optional<double> placed = {}) {
    tbb::parallel_for(0u, ALBEDO_ROWS, [&](uint32_t row) {
        const double alpha = alpha_of(row);
        for (uint32_t column = 0; column < ALBEDO_COLUMNS; column++)
            table[row * ALBEDO_COLUMNS + column] = word_of_two(
                number(cosine_at(column, ALBEDO_COLUMNS, placed.value_or(alpha)), alpha));
        // Of what the kernels will read, so that what is lost and what comes back are the same.
        constexpr int STEPS = 256;
        const double own =
            placed ? *placed : double(row) / (ALBEDO_ROWS - 1) * (double(row) / (ALBEDO_ROWS - 1));
        AlbedoNumbers sum{0, 0};
        for (int i = 0; i < STEPS; i++) {
            const double cosine = (i + 0.5) / STEPS;
            const Between at = between(ALBEDO_PLACE(cosine, own), ALBEDO_COLUMNS);
            const AlbedoNumbers read =
                counted(mix(table, row * ALBEDO_COLUMNS + at.first, 1, at.fraction), cosine);
            sum.first += 2 * cosine / STEPS * read.first;
            sum.second += 2 * cosine / STEPS * read.second;
        }
        table[ALBEDO_MEANS + row] = word_of_two(sum);
    });
}

/// Between entries of the table albedos fall short by less; no surface should gain light by that.
constexpr double LARGEST_ERROR = 7e-4;

AlbedoNumbers reflection_numbers(const ReflectionAlbedo& a, double cosine) {
    const double share = a.grazing / a.white - schlick_weight(cosine) + LARGEST_ERROR;
    return {a.white + LARGEST_ERROR, 0.5 * (share + 1)};
}

template <Distribution distribution>
void fill_reflection(std::span<uint32_t> table) {
    fill_table(
        table,
        [](double cosine, double alpha) {
            return reflection_numbers(reflection_albedo(cosine, alpha, distribution), cosine);
        },
        [](AlbedoNumbers n, double cosine) {
            return AlbedoNumbers{n.first, n.first * (schlick_weight(cosine) + 2 * n.second - 1)};
        });
}

/// The same of the coarse steps of the table with a grain, as a share.
constexpr double LARGEST_GRAIN_ERROR = 0.01;

template <auto albedo>
void fill_grain(std::span<uint32_t> table) {
    constexpr uint32_t ROW = GRAIN_COLUMNS, BLOCK = GRAIN_COLUMNS * ROW;
    tbb::parallel_for(0u, GRAIN_ROWS * GRAIN_ROWS, [&](uint32_t block) {
        const double roughness = double(block / GRAIN_ROWS) / (GRAIN_ROWS - 1);
        const double strength = double(block % GRAIN_ROWS) / (GRAIN_ROWS - 1);
        const double across = std::max(roughness * roughness, LEAST_ALPHA);
        const double along = std::lerp(across, 1.0, strength * strength);
        for (uint32_t row = 0; row < GRAIN_COLUMNS; row++) {
            const double left = 1 - double(row) / (GRAIN_COLUMNS - 1);
            const double azimuth = left * left; // its cosine
            const double seen =
                std::hypot(along * azimuth, across * std::sqrt(1 - azimuth * azimuth));
            for (uint32_t column = 0; column < GRAIN_COLUMNS; column++) {
                const double cosine = cosine_at(column, GRAIN_COLUMNS, seen);
                ReflectionAlbedo a = albedo(cosine, azimuth, along, across);
                const double kept = std::min(a.white * (1 + LARGEST_GRAIN_ERROR), 1.0);
                a.grazing = a.grazing * kept / a.white + LARGEST_GRAIN_ERROR;
                a.white = kept;
                table[block * BLOCK + row * ROW + column] =
                    word_of_two(reflection_numbers(a, cosine));
            }
        }
    });
}

void fill_sheen(std::span<uint32_t> table) {
    fill_table(
        table,
        [](double cosine, double alpha) {
            return AlbedoNumbers{sheen_albedo(cosine, alpha), 0};
        },
        AS_THEY_ARE, double(SHEEN_PLACE_ALPHA));
}

/// Of what glass loses, the part that is given back: quadrature across the edge of total
/// reflection is off by some thousandths of it, and no glass should gain light.
constexpr double GIVEN_BACK = 0.995;

void fill_glass(std::span<uint32_t> table, double ior, Distribution distribution) {
    const auto kept = [](double albedo) { return 1 - GIVEN_BACK * (1 - albedo); };
    fill_table(
        table,
        [&](double cosine, double alpha) {
            const GlassAlbedo a = glass_albedo(cosine, alpha, ior, distribution);
            return AlbedoNumbers{kept(a.outside), kept(a.inside)};
        },
        AS_THEY_ARE);
}

} // namespace

static std::vector<uint32_t> filled(size_t count, void (*fill)(std::span<uint32_t>)) {
    std::vector<uint32_t> words(count);
    fill(words);
    return words;
}

uint32_t AlbedoTables::glass(float ior, Distribution distribution) {
    used_ = true;
    const auto off = [&](const Glass& g) {
        return std::pair(g.distribution != distribution, std::abs(g.ior - ior));
    };
    auto nearest = std::ranges::min_element(glasses_, {}, off);
    const bool found = nearest != glasses_.end() && off(*nearest) == std::pair(false, 0.0f);
    if (!found && glasses_.size() < MOST_GLASS_TABLES) {
        glasses_.push_back({ior, distribution});
        nearest = glasses_.end() - 1;
    }
    return GLASS_TABLES + uint32_t(nearest - glasses_.begin()) * ALBEDO_TABLE;
}

std::vector<uint32_t> AlbedoTables::words() && {
    std::vector<uint32_t> all(GLASS_TABLES + glasses_.size() * ALBEDO_TABLE, NOTHING_LOST);
    if (!used_) return all;
    static const std::vector<uint32_t> reflection =
        filled(ALBEDO_TABLE, fill_reflection<Distribution::ggx>);
    std::ranges::copy(reflection, all.begin());
    if (sheen_) {
        static const std::vector<uint32_t> sheen = filled(ALBEDO_TABLE, fill_sheen);
        std::ranges::copy(sheen, all.begin() + SHEEN_TABLE);
    }
    if (grain_) {
        static const std::vector<uint32_t> grain = filled(GRAIN_WORDS, fill_grain<grain_albedo>);
        std::ranges::copy(grain, all.begin() + GRAIN_TABLE);
    }
    if (beckmann_) {
        static const std::vector<uint32_t> beckmann =
            filled(ALBEDO_TABLE, fill_reflection<Distribution::beckmann>);
        std::ranges::copy(beckmann, all.begin() + BECKMANN_TABLE);
    }
    if (beckmann_ && grain_) {
        static const std::vector<uint32_t> both =
            filled(GRAIN_WORDS, fill_grain<beckmann_grain_albedo>);
        std::ranges::copy(both, all.begin() + BECKMANN_GRAIN_TABLE);
    }
    for (size_t i = 0; i < glasses_.size(); i++)
        fill_glass(std::span(all).subspan(GLASS_TABLES + i * ALBEDO_TABLE, ALBEDO_TABLE),
                   glasses_[i].ior, glasses_[i].distribution);
    return all;
}

AlbedoNumbers albedo_numbers(std::span<const uint32_t> table, double cosine, double alpha) {
    const Between row = between(std::sqrt(alpha), ALBEDO_ROWS);
    const Between column = between(ALBEDO_PLACE(std::max(cosine, 1e-6), alpha), ALBEDO_COLUMNS);
    const uint32_t first = row.first * ALBEDO_COLUMNS + column.first;
    const AlbedoNumbers upper = mix(table, first, 1, column.fraction);
    const AlbedoNumbers lower = mix(table, first + ALBEDO_COLUMNS, 1, column.fraction);
    return {std::lerp(upper.first, lower.first, row.fraction),
            std::lerp(upper.second, lower.second, row.fraction)};
}

} // namespace onde
