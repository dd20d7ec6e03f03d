// The random numbers: pure, in [0, 1), a (0, 2)-sequence in every pair, and independent elsewhere.
#include "kernels/columns.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

#include <set>

using namespace onde;
using namespace onde::test;

namespace {

Probe& probe() {
    static Probe built("basics.cl", 1, {"random"});
    return built;
}

/// The pairs of (pixels[i], samples[i]) in one dimension.
Points draw(const std::vector<uint32_t>& pixels, const std::vector<uint32_t>& samples,
            uint32_t dimension, uint32_t seed) {
    Columns in(4, Column(pixels.size()));
    for (size_t i = 0; i < pixels.size(); i++) {
        in[0][i] = word(pixels[i]);
        in[1][i] = word(samples[i]);
        in[2][i] = word(dimension);
        in[3][i] = word(seed);
    }
    Columns out = probe().run("random", in, 2);
    return {std::move(out[0]), std::move(out[1])};
}

/// The samples first, first + 1, ... of one pixel.
Points sequence(uint32_t pixel, uint32_t dimension, uint32_t count, uint32_t first = 0,
                uint32_t seed = 0) {
    std::vector<uint32_t> samples(count);
    for (uint32_t i = 0; i < count; i++) samples[i] = first + i;
    return draw(std::vector<uint32_t>(count, pixel), samples, dimension, seed);
}

/// Sample `sample` of 2^16 pixels in a square.
Points picture(uint32_t sample, uint32_t dimension, uint32_t seed) {
    std::vector<uint32_t> pixels;
    for (uint32_t y = 0; y < 256; y++)
        for (uint32_t x = 0; x < 256; x++) pixels.push_back(x | y << 16);
    return draw(pixels, std::vector<uint32_t>(pixels.size(), sample), dimension, seed);
}

double correlation(const Column& a, const Column& b) {
    double mean_a = 0, mean_b = 0, ab = 0, aa = 0, bb = 0;
    for (size_t i = 0; i < a.size(); i++) {
        mean_a += a[i];
        mean_b += b[i];
    }
    mean_a /= double(a.size());
    mean_b /= double(b.size());
    for (size_t i = 0; i < a.size(); i++) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
    }
    return ab / std::sqrt(aa * bb);
}

const std::vector<uint32_t> PIXELS{0, 1, 5 | 7 << 16, 1919 | 1079u << 16, 0xffffffffu};

} // namespace

TEST_CASE("random numbers are in [0, 1)") {
    for (uint32_t dimension : {0u, 1u, 2u, 17u, 257u}) {
        const Points points = picture(dimension * 3, dimension, 11);
        for (size_t i = 0; i < points.x.size(); i++) {
            REQUIRE((points.x[i] >= 0 && points.x[i] < 1));
            REQUIRE((points.y[i] >= 0 && points.y[i] < 1));
        }
    }
}

TEST_CASE("a random number depends on its arguments and not on who else is asked") {
    const Points ascending = sequence(77, 3, 64);
    for (uint32_t i : {0u, 5u, 63u}) {
        const Points alone = sequence(77, 3, 1, i);
        CHECK(alone.x[0] == ascending.x[i]);
        CHECK(alone.y[0] == ascending.y[i]);
    }
    CHECK(sequence(78, 3, 64).x != ascending.x);
    CHECK(sequence(77, 4, 64).x != ascending.x);
    CHECK(sequence(77, 3, 64, 0, 1).x != ascending.x);
}

TEST_CASE("the samples of a pair are a (0, 2)-sequence") {
    for (uint32_t pixel : PIXELS)
        for (uint32_t dimension : {0u, 1u, 5u, 30u})
            for (uint32_t k = 0; k <= 8; k++)
                for (uint32_t block : {0u, 1u, 6u}) {
                    INFO("pixel " << pixel << ", dimension " << dimension << ", samples from "
                                  << (block << k) << ", 2^" << k);
                    const Points points = sequence(pixel, dimension, 1u << k, block << k);
                    REQUIRE(find_uneven_interval(points, k) == "");
                }
}

TEST_CASE("the same sample of neighbouring pixels is uniform and uncorrelated") {
    const Points points = picture(3, 2, 0);
    constexpr size_t SIDE = 32, BINS = SIDE * SIDE;
    std::vector<double> observed(BINS);
    for (size_t i = 0; i < points.x.size(); i++)
        observed[size_t(points.y[i] * SIDE) * SIDE + size_t(points.x[i] * SIDE)]++;
    const std::vector<double> expected(BINS, double(points.x.size()) / BINS);
    CHECK(chi_square_failure(observed, expected, 1e-4) == "");
    // The correlation of n independent pairs has deviation 1 / sqrt(n).
    const double bound = 5 / std::sqrt(double(points.x.size()));
    CHECK(std::abs(correlation(points.x, points.y)) < bound);
    for (size_t away : {size_t(1), size_t(2), size_t(256), size_t(257)}) {
        Column shifted(points.x.begin() + ptrdiff_t(away), points.x.end());
        shifted.insert(shifted.end(), points.x.begin(), points.x.begin() + ptrdiff_t(away));
        INFO("pixels " << away << " apart");
        CHECK(std::abs(correlation(points.x, shifted)) < bound);
    }
}

TEST_CASE("different dimensions, seeds and samples of a picture are uncorrelated") {
    const Points points = picture(0, 2, 0);
    const double bound = 5 / std::sqrt(double(points.x.size()));
    const std::vector<Points> others{picture(0, 3, 0), picture(0, 4, 0), picture(0, 0, 0),
                                     picture(0, 6, 0), picture(0, 2, 1)};
    for (const Points& other : others) {
        CHECK(std::abs(correlation(points.x, other.x)) < bound);
        CHECK(std::abs(correlation(points.x, other.y)) < bound);
        CHECK(std::abs(correlation(points.y, other.y)) < bound);
    }
}

TEST_CASE("the dimensions of a pixel are uncorrelated over its samples") {
    // Averaged over pixels, since one pixel's sequences are few numbers that are far from random.
    constexpr uint32_t SAMPLES = 256, PIXEL_COUNT = 64;
    for (uint32_t other : {1u, 2u, 5u, 6u}) {
        double sum = 0;
        for (uint32_t pixel = 0; pixel < PIXEL_COUNT; pixel++)
            sum += correlation(sequence(pixel, 0, SAMPLES).x, sequence(pixel, other, SAMPLES).x);
        INFO("dimension " << other);
        CHECK(std::abs(sum / PIXEL_COUNT) < 5 / std::sqrt(double(SAMPLES) * PIXEL_COUNT));
    }
}

TEST_CASE("smooth functions are integrated ten times better than by independent numbers") {
    // x^2 + x y has the mean 7 / 12 and the variance 1 / 5 + 1 / 4 + 1 / 9 - 49 / 144.
    constexpr uint32_t SAMPLES = 1024, PIXEL_COUNT = 64;
    double squares = 0;
    for (uint32_t pixel = 0; pixel < PIXEL_COUNT; pixel++) {
        const Points points = sequence(pixel * 131, 4, SAMPLES);
        double sum = 0;
        for (uint32_t i = 0; i < SAMPLES; i++)
            sum += double(points.x[i]) * (double(points.x[i]) + double(points.y[i]));
        squares += std::pow(sum / SAMPLES - 7.0 / 12, 2);
    }
    const double variance = 1.0 / 5 + 1.0 / 4 + 1.0 / 9 - 49.0 / 144;
    CHECK(std::sqrt(squares / PIXEL_COUNT) < 0.1 * std::sqrt(variance / SAMPLES));
}

TEST_CASE("the place in the pixel and the first direction are stratified together") {
    // Products of two coordinates about their middles have the mean 0 and the variance 1 / 144.
    constexpr uint32_t SAMPLES = 64, PIXEL_COUNT = 256, FIRST_DIRECTION = 4;
    const auto variance = [&](uint32_t dimension, bool place_y, bool other_y) {
        double squares = 0;
        for (uint32_t pixel = 0; pixel < PIXEL_COUNT; pixel++) {
            const Points place = sequence(pixel, 0, SAMPLES);
            const Points other = sequence(pixel, dimension, SAMPLES);
            const Column &a = place_y ? place.y : place.x, &b = other_y ? other.y : other.x;
            double sum = 0;
            for (size_t i = 0; i < SAMPLES; i++) sum += (double(a[i]) - 0.5) * (double(b[i]) - 0.5);
            squares += sum / SAMPLES * sum / SAMPLES;
        }
        return squares / PIXEL_COUNT * 144 * SAMPLES; // over that of independent numbers
    };
    for (bool place_y : {false, true})
        for (bool other_y : {false, true}) {
            INFO((place_y ? "y" : "x") << " with " << (other_y ? "y" : "x"));
            CHECK(variance(FIRST_DIRECTION, place_y, other_y) < 0.25);
        }
    CHECK(variance(3, false, false) > 0.5); // which pairs of their own are not
}

TEST_CASE("different pixels have different sequences") {
    std::set<float> firsts;
    const Points points = picture(0, 0, 0);
    firsts.insert(points.x.begin(), points.x.end());
    // Of n 24-bit numbers about n^2 / 2^25 coincide: 128 here, with deviation 11.
    CHECK(firsts.size() > points.x.size() - 128 - 60);
}
