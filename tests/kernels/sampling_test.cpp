// Samplers against their densities.
#include "kernels/columns.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

namespace {

constexpr size_t COUNT = 1 << 18;
constexpr double SIGNIFICANCE = 1e-4 / 8; // of each of the 8 chi-square tests here

Probe& probe() {
    static Probe built("basics.cl", 1, {"sampling", "heuristic"});
    return built;
}

/// Outputs of probe_sampling: where each sampler's words begin.
enum Word : size_t { DISK = 0, COSINE = 2, CONE = 5, SPHERE = 8, TRIANGLE = 11, PDF_COSINE = 13 };

Columns draw(float opening = 1.0f) {
    Generator generator(17);
    const Columns in{uniform_column(generator, COUNT), uniform_column(generator, COUNT),
                     constant_column(COUNT, opening)};
    return probe().run("sampling", in, 15);
}

/// Counts samples by z in 64 equal bins and azimuth in 16, and compares with `share`, the
/// probability that z is below its argument.
template <class Share>
std::string compare(const Columns& out, size_t k, double low, const Share& share) {
    constexpr size_t ROWS = 64, AROUND = 16;
    std::vector<double> observed(ROWS * AROUND), expected(ROWS * AROUND);
    for (size_t i = 0; i < COUNT; i++) {
        const glm::dvec3 v = vector_at(out, k, i);
        const double turns = std::atan2(v.y, v.x) / (2 * M_PI) + 0.5;
        const auto row = size_t(std::clamp((v.z - low) / (1 - low), 0.0, 1.0) * ROWS);
        const auto column = size_t(turns * AROUND);
        observed[std::min(row, ROWS - 1) * AROUND + std::min(column, AROUND - 1)]++;
    }
    for (size_t i = 0; i < expected.size(); i++) {
        const double z = low + (1 - low) * double(i / AROUND) / ROWS;
        expected[i] = double(COUNT) / AROUND * (share(z + (1 - low) / ROWS) - share(z));
    }
    return chi_square_failure(observed, expected, SIGNIFICANCE);
}

std::string find_not_unit(const Columns& out, size_t k) {
    return worst_item(
        COUNT, 1e-6, [&](size_t i) { return std::abs(glm::length(vector_at(out, k, i)) - 1); },
        [&](size_t i) {
            return fmt::format("({}, {}, {})", out[k][i], out[k + 1][i], out[k + 2][i]);
        });
}

} // namespace

TEST_CASE("the chi-square tail agrees with the tables") {
    CHECK(chi_square_tail(3.841, 1) == Approx(0.05).epsilon(1e-3));
    CHECK(chi_square_tail(18.307, 10) == Approx(0.05).epsilon(1e-3));
    CHECK(chi_square_tail(149.449, 100) == Approx(0.001).epsilon(1e-3));
    CHECK(chi_square_tail(67.328, 100) == Approx(0.995).epsilon(1e-3));
}

TEST_CASE("points on the disk are uniform") {
    const Columns out = draw();
    constexpr size_t SIDE = 32;
    std::vector<double> observed(SIDE * SIDE);
    for (size_t i = 0; i < COUNT; i++) {
        const double x = out[DISK][i], y = out[DISK + 1][i];
        const double r2 = x * x + y * y;
        REQUIRE(r2 <= 1 + 1e-6);
        const auto ring = std::min(size_t(r2 * SIDE), SIDE - 1);
        const auto sector = size_t((std::atan2(y, x) / (2 * M_PI) + 0.5) * SIDE);
        observed[ring * SIDE + std::min(sector, SIDE - 1)]++;
    }
    const std::vector<double> expected(SIDE * SIDE, double(COUNT) / (SIDE * SIDE));
    CHECK(chi_square_failure(observed, expected, SIGNIFICANCE) == "");
}

TEST_CASE("the cosine hemisphere is sampled by its pdf") {
    const Columns out = draw();
    CHECK(find_not_unit(out, COSINE) == "");
    CHECK(compare(out, COSINE, 0, [](double z) { return z * z; }) == "");
    const auto wanted = [&](size_t i) { return double(out[COSINE + 2][i]) / M_PI; };
    CHECK(worst_difference(out[PDF_COSINE], wanted, 1e-6) == "");
}

TEST_CASE("cones are sampled uniformly, and their pdf integrates to one") {
    for (float opening : {2.0f, 1.0f, 0.3f, 1e-3f}) {
        INFO("1 - cos of the half angle is " << opening);
        const Columns out = draw(opening);
        CHECK(find_not_unit(out, CONE) == "");
        const double low = 1 - double(opening);
        CHECK(compare(out, CONE, low, [&](double z) { return (z - low) / opening; }) == "");
        CHECK(double(out[PDF_COSINE + 1][0]) * 2 * M_PI * opening == Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("a narrow cone keeps its shape where the cosine rounds to one") {
    const double opening = 1e-9;
    const Columns out = draw(float(opening));
    double largest = 0, sum = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const double r2 = std::pow(out[CONE][i], 2) + std::pow(out[CONE + 1][i], 2);
        largest = std::max(largest, r2);
        sum += r2;
    }
    CHECK(largest <= 2 * opening * (1 + 1e-6));
    // Uniform in [0, 2 opening]: the mean's relative deviation is 1 / sqrt(3 n).
    CHECK(sum / COUNT == Approx(opening).epsilon(5 / std::sqrt(3.0 * COUNT)));
}

TEST_CASE("the sphere is sampled uniformly") {
    const Columns out = draw();
    CHECK(find_not_unit(out, SPHERE) == "");
    CHECK(compare(out, SPHERE, -1, [](double z) { return (z + 1) / 2; }) == "");
}

TEST_CASE("points on triangles are uniform") {
    const Columns out = draw();
    // Halves of a grid's cells: the triangle b1 + b2 < 1 consists of SIDE^2 alike.
    constexpr size_t SIDE = 32;
    std::vector<double> observed(2 * SIDE * SIDE);
    for (size_t i = 0; i < COUNT; i++) {
        const double x = double(out[TRIANGLE][i]) * SIDE, y = double(out[TRIANGLE + 1][i]) * SIDE;
        REQUIRE((x >= 0 && y >= 0 && x + y <= SIDE * (1 + 1e-6)));
        const double inside = x - std::floor(x) + y - std::floor(y);
        const size_t cell = std::min(size_t(y), SIDE - 1) * SIDE + std::min(size_t(x), SIDE - 1);
        observed[2 * cell + (inside > 1)]++;
    }
    std::vector<double> expected(observed.size());
    for (size_t y = 0; y < SIDE; y++)
        for (size_t x = 0; x < SIDE; x++)
            for (size_t upper = 0; upper < 2; upper++)
                if (x + y + upper < SIDE)
                    expected[2 * (y * SIDE + x) + upper] = double(COUNT) / (SIDE * SIDE);
    CHECK(chi_square_failure(observed, expected, SIGNIFICANCE) == "");
}

TEST_CASE("the power heuristic's weights sum to one and are those of the squares") {
    Generator generator(23);
    Columns in(2);
    for (size_t i = 0; i < 4096; i++)
        for (Column& column : in)
            column.push_back(float(std::exp2(60 * double(unit(generator)) - 30)));
    const Column own = probe().run("heuristic", in, 1)[0];
    const auto wanted = [&](size_t i) {
        const double a = std::pow(double(in[0][i]), 2), b = std::pow(double(in[1][i]), 2);
        return a / (a + b);
    };
    CHECK(worst_difference(own, wanted, 1e-6) == "");
    std::swap(in[0], in[1]);
    const Column other = probe().run("heuristic", in, 1)[0];
    CHECK(worst_difference(
              other, [&](size_t i) { return 1 - own[i]; }, 1e-6) == "");
}

TEST_CASE("the power heuristic bears densities of zero and infinity") {
    const float infinity = std::numeric_limits<float>::infinity();
    const Column weights = probe().run("heuristic", {{1, 1, 1e-30f}, {0, infinity, 1e30f}}, 1)[0];
    CHECK(weights == Column{1.0f, 0.0f, 0.0f});
}
