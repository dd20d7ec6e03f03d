// Elementary functions against double precision, with the error bounds that they state.
#include "doctor/exact.h"
#include "kernels/columns.h"
#include "upload/octahedral.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;
using doctor::turns_of;

namespace {

constexpr size_t COUNT = 1 << 16;

Probe& probe() {
    static Probe built("basics.cl", 1, {"math", "powers", "basis"});
    return built;
}

} // namespace

TEST_CASE("sine and cosine of turns are within 3e-7") {
    Generator generator(1);
    Columns in{uniform_column(generator, COUNT, -4, 4)};
    for (int i = -16; i <= 16; i++) in[0][size_t(i + 16)] = float(i) / 8;
    in.resize(4, in[0]);
    const Columns out = probe().run("math", in, 6);
    const auto angle = [&](size_t i) { return 2 * M_PI * double(in[0][i]); };
    CHECK(worst_difference(
              out[0], [&](size_t i) { return std::sin(angle(i)); }, 3e-7) == "");
    CHECK(worst_difference(
              out[1], [&](size_t i) { return std::cos(angle(i)); }, 3e-7) == "");
}

TEST_CASE("logarithms and powers of two are within the bounds that they state") {
    Generator generator(4);
    Columns in{{}, uniform_column(generator, COUNT, -126, 127), {}, {}};
    for (size_t i = 0; i < COUNT; i++) {
        // Half of them close to 1, where only the relative error says anything.
        const double spread = i % 2 ? 60 : 1e-3;
        in[0].push_back(float(std::exp2(spread * (2 * double(unit(generator)) - 1))));
        in[2].push_back(i % 2 ? unit(generator) : 1e-3f * unit(generator));
        in[3].push_back(1000 * unit(generator));
    }
    const Columns out = probe().run("powers", in, 3);
    const auto log_error = [&](size_t i) {
        const double wanted = std::log2(double(in[0][i]));
        return std::abs(out[0][i] - wanted) / std::max(1.0, std::abs(wanted));
    };
    CHECK(worst_item(COUNT, 2e-7, log_error, [&](size_t i) {
              return fmt::format("log2 {}: {}", in[0][i], out[0][i]);
          }) == "");
    const auto exp_error = [&](size_t i) {
        return std::abs(out[1][i] / std::exp2(double(in[1][i])) - 1);
    };
    CHECK(worst_item(COUNT, 3e-7, exp_error,
                     [&](size_t i) { return fmt::format("2^{}: {}", in[1][i], out[1][i]); }) == "");
    CHECK(worst_difference(
              out[2], [&](size_t i) { return std::pow(1 - double(in[2][i]), double(in[3][i])); },
              2e-6) == "");
}

TEST_CASE("zero to the zero is one, to anything else zero, and one to anything one") {
    const Columns in{{1, 1, 1}, {0, 0, 0}, {1, 1, 0}, {0, 3, 1e6f}};
    CHECK(probe().run("powers", in, 3)[2] == std::vector<float>{1, 0, 1});
}

TEST_CASE("the angle in turns is within 1e-6, all the way around") {
    Generator generator(2);
    Columns in{constant_column(COUNT, 0), {}, {}, constant_column(COUNT, 0)};
    for (size_t i = 0; i < COUNT; i++) {
        const double a = 2 * M_PI * double(i) / COUNT;
        const double r = std::exp2(40 * double(unit(generator)) - 20);
        in[1].push_back(float(r * std::sin(a)));
        in[2].push_back(float(r * std::cos(a)));
    }
    const Columns out = probe().run("math", in, 6);
    const auto wanted = [&](size_t i) { return turns_of(in[1][i], in[2][i]); };
    const auto around = [&](size_t i) { // 0 and 1 are the same direction
        const double d = std::abs(double(out[2][i]) - wanted(i));
        return std::min(d, std::abs(d - 1));
    };
    CHECK(worst_item(COUNT, 1e-6, around, [&](size_t i) {
              return fmt::format("{} instead of {}", out[2][i], wanted(i));
          }) == "");
    for (float a : out[2]) REQUIRE((a >= 0 && a <= 1));
}

TEST_CASE("the angle of the axes and of nothing is exact") {
    const Columns in{Column(5, 0.0f), {0, 0, 2, 0, -3}, {0, 1, 0, -2, 0}, Column(5, 0.0f)};
    CHECK(probe().run("math", in, 6)[2] == Column{0.0f, 0.0f, 0.25f, 0.5f, 0.75f});
}

TEST_CASE("octahedral words give back the vectors that were encoded, within 7e-5 radians") {
    Generator generator(3);
    std::vector<glm::vec3> vectors = unit_vectors(generator, COUNT);
    for (uint32_t k = 0; k < 6; k++) {
        vectors[k] = glm::vec3(0);
        vectors[k][k / 2] = k % 2 ? -1.0f : 1.0f;
    }
    Columns in(4, constant_column(COUNT, 0));
    for (size_t i = 0; i < COUNT; i++) in[3][i] = word(encode_octahedral(vectors[i]));
    const Columns out = probe().run("math", in, 6);
    const auto angle = [&](size_t i) {
        const glm::dvec3 a = vector_at(out, 3, i), b(vectors[i]);
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    };
    const auto describe = [&](size_t i) {
        return fmt::format("({}, {}, {}) instead of ({}, {}, {})", out[3][i], out[4][i], out[5][i],
                           vectors[i].x, vectors[i].y, vectors[i].z);
    };
    CHECK(worst_item(COUNT, 7e-5, angle, describe) == "");
}

TEST_CASE("every octahedral word decodes to a unit vector") {
    Generator generator(4);
    Columns in(4, Column(COUNT));
    for (float& a : in[3]) a = word(uint32_t(generator()));
    in[3][0] = word(0x80008000u);
    in[3][1] = word(0x7fff8000u);
    const Columns out = probe().run("math", in, 6);
    const auto error = [&](size_t i) { return std::abs(glm::length(vector_at(out, 3, i)) - 1); };
    CHECK(worst_item(COUNT, 2e-7, error, [&](size_t i) {
              return fmt::format("word {:#x}", from_word(in[3][i]));
          }) == "");
}

TEST_CASE("the basis around a normal is orthonormal and right-handed, near the poles too") {
    Generator generator(5);
    std::vector<glm::vec3> normals = unit_vectors(generator, COUNT);
    normals[0] = {0, 0, 1};
    normals[1] = {0, 0, -1};
    normals[2] = glm::normalize(glm::vec3(1e-4f, 0, -1));
    normals[3] = glm::normalize(glm::vec3(0, -1e-7f, -1));
    normals[4] = {1, 0, 0};
    normals[5] = {0, 1, -0.0f};
    Columns in;
    add_vectors(in, normals);
    add_vectors(in, unit_vectors(generator, COUNT));
    const Columns out = probe().run("basis", in, 15);
    const auto skew = [&](size_t i) {
        const glm::dmat3 m(vector_at(out, 0, i), vector_at(out, 3, i), vector_at(out, 6, i));
        const glm::dmat3 rest = glm::transpose(m) * m - glm::dmat3(1);
        double largest = std::abs(glm::determinant(m) - 1);
        for (size_t c = 0; c < 3; c++)
            for (size_t r = 0; r < 3; r++) largest = std::max(largest, std::abs(rest[c][r]));
        return largest;
    };
    const auto describe = [&](size_t i) {
        return fmt::format("normal ({}, {}, {})", in[0][i], in[1][i], in[2][i]);
    };
    CHECK(worst_item(COUNT, 1e-6, skew, describe) == "");
    for (size_t k = 0; k < 3; k++)
        CHECK(worst_difference(
                  out[12 + k], [&](size_t i) { return in[3 + k][i]; }, 1e-6) == "");
}
