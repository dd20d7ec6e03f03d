// Reflectances against closed forms.
#include "doctor/exact.h"
#include "kernels/columns.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;
using doctor::reflectance;

namespace {

Columns fresnel(Column cosines, float eta, glm::vec3 f0 = glm::vec3(0.04f), float f90 = 1) {
    static Probe probe("basics.cl", 1, {"fresnel"});
    const size_t count = cosines.size();
    const Columns in{std::move(cosines),           constant_column(count, eta),
                     constant_column(count, f0.x), constant_column(count, f0.y),
                     constant_column(count, f0.z), constant_column(count, f90)};
    return probe.run("fresnel", in, 4);
}

Column cosines() {
    Column column;
    for (int i = 0; i <= 1000; i++) column.push_back(float(i) / 1000);
    return column;
}

} // namespace

TEST_CASE("at normal incidence glass reflects ((n - 1) / (n + 1))^2") {
    for (float n : {1.0f, 1.33f, 1.5f, 2.4f, 1 / 1.5f}) {
        const double wanted = std::pow((n - 1) / (n + 1), 2);
        CHECK(fresnel({1.0f}, n)[0][0] == Approx(wanted).margin(1e-7));
    }
}

TEST_CASE("glass reflects what the Fresnel equations say at every angle") {
    for (float n : {1.1f, 1.5f, 2.4f, 1 / 1.1f, 1 / 1.5f}) {
        INFO("index " << n);
        const Column angles = cosines();
        const Column got = fresnel(angles, n)[0];
        // The reflectance is a square root near the critical angle, where rounding shows.
        const double bound = n < 1 ? 2e-3 : 1e-5;
        CHECK(worst_difference(
                  got, [&](size_t i) { return reflectance(angles[i], n); }, bound) == "");
        for (float f : got) REQUIRE((f >= 0 && f <= 1));
    }
}

TEST_CASE("at Brewster's angle only one polarisation is reflected") {
    // There tan = n, the refracted ray is perpendicular, and the other one is reflected by
    // ((n^2 - 1) / (n^2 + 1))^2.
    for (double n : {1.33, 1.5, 2.4}) {
        const double wanted = std::pow((n * n - 1) / (n * n + 1), 2) / 2;
        const auto cosine = float(1 / std::sqrt(1 + n * n));
        CHECK(fresnel({cosine}, float(n))[0][0] == Approx(wanted).epsilon(1e-5));
    }
}

TEST_CASE("beyond the critical angle everything is reflected") {
    const double n = 1 / 1.5, critical = std::sqrt(1 - n * n);
    const Column got = fresnel(
        {0.0f, float(critical * 0.5), float(critical - 1e-6), float(critical * 1.01)}, float(n))[0];
    CHECK(got[0] == 1.0f);
    CHECK(got[1] == 1.0f);
    CHECK(got[2] == 1.0f);
    CHECK(got[3] < 0.7f);
}

TEST_CASE("reflection at grazing is total, and none at equal indices") {
    CHECK(fresnel({0.0f}, 1.5f)[0][0] == 1.0f);
    const Column none = fresnel({0.1f, 0.5f, 1.0f}, 1.0f)[0];
    CHECK(worst_difference(
              none, [](size_t) { return 0.0; }, 1e-12) == "");
}

TEST_CASE("light refracted there and back is reflected alike on both sides") {
    const Column angles = cosines();
    Column inside;
    const double n = 1.5;
    for (float c : angles)
        inside.push_back(float(std::sqrt(1 - (1 - double(c) * double(c)) / (n * n))));
    const Column out = fresnel(angles, float(n))[0], in = fresnel(inside, float(1 / n))[0];
    // Near grazing, inside is at its critical angle, where one rounding of the cosine shows.
    CHECK(worst_difference(
              in, [&](size_t i) { return out[i]; }, 2e-3) == "");
}

TEST_CASE("Schlick's reflectance goes from f0 to f90 by the fifth power") {
    const Column angles = cosines();
    const glm::dvec3 f0(0.04, 0.5, 1);
    const Columns out = fresnel(angles, 1.5f, glm::vec3(f0), 0.9f);
    for (uint32_t k = 0; k < 3; k++) {
        const auto wanted = [&](size_t i) {
            return f0[k] + (double(0.9f) - f0[k]) * std::pow(1 - double(angles[i]), 5);
        };
        CHECK(worst_difference(out[1 + k], wanted, 3e-7) == "");
    }
}

TEST_CASE("Schlick's reflectance stays in its range for cosines that rounding pushed outside") {
    const Columns out = fresnel({1.0001f, -0.0001f}, 1.5f, glm::vec3(0.04f), 1);
    CHECK(out[1][0] == 0.04f);
    CHECK(out[1][1] == Approx(1).epsilon(1e-6));
}
