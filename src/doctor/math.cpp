// Elementary functions, Fresnel terms and sampled shapes against double precision, within the
// bounds that the kernels state.
#include "doctor/checks.h"
#include "doctor/columns.h"
#include "doctor/exact.h"
#include "doctor/tally.h"
#include "gpu/settings.h"
#include "upload/octahedral.h"

namespace onde::doctor {

namespace {

constexpr size_t COUNT = 1 << 13;

/// Each column's values against wanted(i), a comparison each.
template <class Wanted>
void expect_column(Tally& tally, const Column& got, double bound, std::string_view of,
                   const Wanted& wanted) {
    for (size_t i = 0; i < got.size(); i++)
        tally.expect_near(double(got[i]), double(wanted(i)), bound, of);
}

void check_angles(Tally& tally, Probe& probe) {
    Generator generator(1);
    Columns in{uniform_column(generator, COUNT, -4, 4), {}, {}, {}};
    const std::vector<glm::vec3> vectors = unit_vectors(generator, COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        const double a = 2 * M_PI * double(i) / COUNT, r = std::exp2(double(i % 40) - 20);
        in[1].push_back(float(r * std::sin(a)));
        in[2].push_back(float(r * std::cos(a)));
        in[3].push_back(word(encode_octahedral(vectors[i])));
    }
    const Columns out = probe.run("math", in, 6);
    const auto angle = [&](size_t i) { return 2 * M_PI * double(in[0][i]); };
    expect_column(tally, out[0], 3e-7, "a sine", [&](size_t i) { return std::sin(angle(i)); });
    expect_column(tally, out[1], 3e-7, "a cosine", [&](size_t i) { return std::cos(angle(i)); });
    for (size_t i = 0; i < COUNT; i++) { // 0 and 1 are the same direction
        const double off = double(out[2][i]) - turns_of(in[1][i], in[2][i]);
        tally.expect_near(off - std::round(off), 0, 1e-6, "what an angle is off by");
        const double apart = glm::length(vector_at(out, 3, i) - glm::dvec3(vectors[i]));
        tally.expect_near(apart, 0, 7e-5, "what an octahedral vector is off by");
    }
}

void check_powers(Tally& tally, Probe& probe) {
    Generator generator(4);
    Columns in{{},
               uniform_column(generator, COUNT, -126, 127),
               uniform_column(generator, COUNT),
               uniform_column(generator, COUNT, 0, 1000)};
    for (size_t i = 0; i < COUNT; i++)
        in[0].push_back(float(std::exp2(60 * (2 * double(unit(generator)) - 1))));
    const Columns out = probe.run("powers", in, 3);
    for (size_t i = 0; i < COUNT; i++) {
        const double log = std::log2(double(in[0][i]));
        tally.expect_near(out[0][i], log, 2e-7 * std::max(1.0, std::abs(log)), "a logarithm");
        const double power = std::exp2(double(in[1][i]));
        tally.expect_near(out[1][i], power, 3e-7 * power, "a power of two");
        tally.expect_near(out[2][i], std::pow(1 - double(in[2][i]), double(in[3][i])), 2e-6,
                          "a power");
    }
}

void check_bases(Tally& tally, Probe& probe) {
    Generator generator(5);
    Columns in;
    add_vectors(in, unit_vectors(generator, COUNT));
    add_vectors(in, unit_vectors(generator, COUNT));
    const Columns out = probe.run("basis", in, 15);
    for (size_t i = 0; i < COUNT; i++) {
        const glm::dmat3 m(vector_at(out, 0, i), vector_at(out, 3, i), vector_at(out, 6, i));
        const glm::dmat3 rest = glm::transpose(m) * m - glm::dmat3(1);
        double skew = std::abs(glm::determinant(m) - 1);
        for (size_t k = 0; k < 9; k++) skew = std::max(skew, std::abs(rest[k / 3][k % 3]));
        tally.expect_near(skew, 0, 1e-6, "the skew of a basis");
        const double there_and_back = glm::length(vector_at(out, 12, i) - vector_at(in, 3, i));
        tally.expect_near(there_and_back, 0, 1e-6, "what a vector loses in a basis");
    }
}

void check_fresnel(Tally& tally, Probe& probe) {
    Generator generator(6);
    for (const float eta : {1.1f, 1.5f, 2.4f, 1 / 1.5f}) {
        const Columns in{uniform_column(generator, COUNT), constant_column(COUNT, eta),
                         constant_column(COUNT, 0.04f),    constant_column(COUNT, 0.5f),
                         constant_column(COUNT, 1.0f),     constant_column(COUNT, 0.9f)};
        const Columns out = probe.run("fresnel", in, 4);
        // Near the critical angle the reflectance is a square root, where rounding shows.
        expect_column(tally, out[0], eta < 1 ? 2e-3 : 1e-5, "the reflectance of glass",
                      [&](size_t i) { return reflectance(in[0][i], eta); });
        for (size_t k = 0; k < 3; k++)
            expect_column(tally, out[1 + k], 3e-7, "Schlick's reflectance", [&](size_t i) {
                const double f0 = in[2 + k][i];
                return f0 + (double(0.9f) - f0) * std::pow(1 - double(in[0][i]), 5);
            });
    }
}

/// Points and directions are where the maps of the uniform numbers place them.
void check_shapes(Tally& tally, Probe& probe) {
    Generator generator(17);
    const Columns in{uniform_column(generator, COUNT), uniform_column(generator, COUNT),
                     uniform_column(generator, COUNT, 0.01f, 2)};
    const Columns out = probe.run("sampling", in, 15);
    const auto expect = [&](size_t word, size_t i, double wanted, const char* of) {
        tally.expect_near(out[word][i], wanted, 2e-6, of);
    };
    for (size_t i = 0; i < COUNT; i++) {
        const double u = in[0][i], angle = 2 * M_PI * double(in[1][i]), opening = in[2][i];
        const glm::dvec2 around(std::cos(angle), std::sin(angle));
        expect(0, i, std::sqrt(u) * around.x, "a point on the disk");
        expect(1, i, std::sqrt(u) * around.y, "a point on the disk");
        expect(4, i, std::sqrt(1 - u), "a cosine of the hemisphere");
        expect(7, i, 1 - u * opening, "a cosine in a cone");
        expect(10, i, 1 - 2 * u, "a cosine of the sphere");
        expect(13, i, std::sqrt(1 - u) / M_PI, "the density of the hemisphere");
        const double cone = 1 / (2 * M_PI * opening);
        tally.expect_near(out[14][i], cone, 1e-6 * cone, "the density of a cone");
        for (const size_t k : {2u, 5u, 8u})
            tally.expect_near(glm::length(vector_at(out, k, i)), 1, 1e-6, "a direction's length");
        const double least = std::min(in[0][i], in[1][i]), most = std::max(in[0][i], in[1][i]);
        expect(11, i, in[1][i] > in[0][i] ? least / 2 : most - least / 2, "a triangle's weight");
        expect(12, i, in[1][i] > in[0][i] ? most - least / 2 : least / 2, "a triangle's weight");
    }
    Columns densities(2);
    for (size_t i = 0; i < COUNT; i++)
        for (Column& column : densities)
            column.push_back(float(std::exp2(60 * double(unit(generator)) - 30)));
    const Column weights = probe.run("heuristic", densities, 1)[0];
    expect_column(tally, weights, 1e-6, "a weight of the power heuristic", [&](size_t i) {
        const double a = std::pow(double(densities[0][i]), 2),
                     b = std::pow(double(densities[1][i]), 2);
        return a / (a + b);
    });
}

} // namespace

Finding check_math(const CheckContext& context) {
    Probe probe(context.programs, "basics.cl", gpu::default_settings(context.facts()).width,
                {"math", "powers", "basis", "fresnel", "sampling", "heuristic"});
    Tally tally;
    check_angles(tally, probe);
    check_powers(tally, probe);
    check_bases(tally, probe);
    check_fresnel(tally, probe);
    check_shapes(tally, probe);
    return tally.finding("values are off");
}

} // namespace onde::doctor
