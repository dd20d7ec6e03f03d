// Spectra and the colours that the eye makes of them, against published numbers.
#include "scene/measured.h"
#include "scene/spectrum/curve.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace onde::spectrum;

namespace {

void check_near(const glm::dvec3& color, const glm::dvec3& wanted, double tolerance) {
    for (glm::length_t c = 0; c < 3; ++c) {
        INFO(c);
        CHECK(std::abs(color[c] - wanted[c]) <= tolerance * std::max(1.0, std::abs(wanted[c])));
    }
}

} // namespace

TEST_CASE("light of equal energy has the luminance 1, and D65 is white") {
    CHECK(luminance(color_of_light([](double) { return 1.0; })) == Approx(1.0).epsilon(1e-4));
    const glm::dvec3 day = color_of_light(d65);
    check_near(day / day.y, glm::dvec3(1.0), 1e-3);
    check_near(color_of_surface([](double) { return 0.5; }), glm::dvec3(0.5), 1e-9);
}

TEST_CASE("a table of wavelengths has the colour that Mitsuba's Cornell box states for it") {
    const auto grey = curve_of_pairs({400, 0.78, 500, 0.78, 600, 0.78, 700, 0.78});
    REQUIRE(grey);
    check_near(color_of_light(*grey), {0.936461, 0.740433, 0.705267}, 2e-3);
}

TEST_CASE("a curve is linear between its values and 0 beyond them, unless it goes on") {
    const Curve curve({400, 500}, {1, 3});
    CHECK(curve(450) == Approx(2.0));
    CHECK(curve(400) == 1.0);
    CHECK(curve(500) == 3.0);
    CHECK(curve(399.9) == 0.0);
    CHECK(Curve({400, 500}, {1, 3}, true)(900) == 3.0);
    CHECK(Curve()(500) == 0.0);
}

TEST_CASE("pairs that do not rise, are odd or no numbers are no spectrum") {
    for (const std::vector<double>& numbers : std::vector<std::vector<double>>{
             {}, {400}, {400, 1, 400, 2}, {500, 1, 400, 2}, {400, NAN}, {INFINITY, 1}})
        CHECK_FALSE(curve_of_pairs(numbers));
}

TEST_CASE("black bodies are red when they are cool and blue when they are hot") {
    const glm::dvec3 cool = color_of_light(black_body(2000)),
                     hot = color_of_light(black_body(20000));
    CHECK(cool.x > 2.0 * cool.y);
    CHECK(hot.z > 1.3 * hot.x);
    // The chromaticity of 6500 K is 0.3135, 0.3237 (CIE 15): a little redder than D65.
    const glm::dvec3 c = color_of_light(black_body(6500));
    check_near(c / c.y, {1.05, 1.0, 1.03}, 0.03);
}

TEST_CASE("metals reflect what they are known to") {
    const auto color_of = [](const char* symbol) {
        const auto index = conductor_index(symbol);
        REQUIRE(index);
        return color_of_surface(
            [&](double w) { return onde::conductor_reflectance(1.0, index->eta(w), index->k(w)); });
    };
    // As physicallybased.info has them, of other measurements.
    check_near(color_of("Ag"), {0.962, 0.949, 0.922}, 0.06);
    check_near(color_of("Al"), {0.912, 0.914, 0.920}, 0.06);
    check_near(color_of("Au"), {1.059, 0.773, 0.307}, 0.06);
    check_near(color_of("Cr"), {0.555, 0.556, 0.554}, 0.06);
    check_near(color_of("Cu"), {0.932, 0.623, 0.522}, 0.06);
    CHECK_FALSE(conductor_index("Xx"));
    CHECK(onde::conductor_reflectance(1.0, 1.5, 0.0) == Approx(0.04));
    // Without absorption they are dielectrics, and Brewster's angle shows half of one polarisation.
    CHECK(onde::conductor_reflectance(1.0 / std::sqrt(1.0 + 2.25), 1.5, 0.0) ==
          Approx(0.5 * std::pow((2.25 - 1.0) / (2.25 + 1.0), 2.0)));
    CHECK(onde::conductor_reflectance(1e-6, 0.2, 3.0) == Approx(1.0).epsilon(1e-4));
    // By complex amplitudes: silver, chromium, aluminium.
    CHECK(onde::edge_tint(0.15, 3.5) == Approx(0.98561).epsilon(1e-4));
    CHECK(onde::edge_tint(3.2, 3.3) == Approx(0.74359).epsilon(1e-4));
    CHECK(onde::edge_tint(1.2, 7.0) == Approx(0.88921).epsilon(1e-4));
}

TEST_CASE("a plastic's coat sends back what meets its inside") {
    CHECK(onde::internal_reflectance(1.5) == Approx(0.5963).epsilon(1e-3)); // as Egan and Hilgeman
    CHECK(onde::internal_reflectance(1.0) == Approx(0.0).margin(1e-9));
    onde::Material plastic;
    onde::set_plastic(plastic, 1.5);
    CHECK(plastic.kind == onde::MaterialKind::metallic_roughness);
    CHECK(plastic.inner_reflection.value_or(0.0f) == Approx(0.5963).epsilon(1e-3));
}

TEST_CASE("two alphas become a roughness and a grain") {
    onde::Material m;
    onde::set_alphas(m, 0.25, 0.25);
    CHECK(m.roughness == 0.5f);
    CHECK(m.anisotropy == 0.0f);
    onde::set_alphas(m, 0.04, 0.5);
    CHECK(m.roughness == Approx(0.2));
    CHECK(0.04 + 0.96 * m.anisotropy * m.anisotropy == Approx(0.5));
    CHECK(m.anisotropy_rotation == Approx(M_PI / 2));
}
