// Directional albedos: quadrature over microfacets against quadrature over directions, and tables
// against both.
#include "upload/albedo_tables.h"
#include "upload/microfacet_albedo.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace onde;

namespace {

/// What a white GGX surface reflects, from the BSDF itself, over the directions that light leaves
/// in.
ReflectionAlbedo by_directions(double cosine, double alpha) {
    constexpr int POLAR = 1500, AROUND = 400;
    const double a2 = alpha * alpha, sine = std::sqrt(1 - cosine * cosine);
    const auto root = [&](double c) { return std::sqrt(a2 + (1 - a2) * c * c); };
    ReflectionAlbedo sum{0, 0};
    for (int i = 0; i < POLAR; i++)
        for (int j = 0; j < AROUND; j++) {
            const double theta = (i + 0.5) / POLAR * M_PI / 2, phi = (j + 0.5) / AROUND * M_PI;
            const double x = std::sin(theta) * std::cos(phi), y = std::sin(theta) * std::sin(phi);
            const double z = std::cos(theta);
            const double hx = x + sine, hz = z + cosine;
            const double length = std::sqrt(hx * hx + y * y + hz * hz);
            const double up = hz / length, out = (hx * sine + hz * cosine) / length;
            const double d = a2 / (M_PI * std::pow(up * up * (a2 - 1) + 1, 2));
            const double visibility = 0.5 / (z * root(cosine) + cosine * root(z));
            const double area = std::sin(theta) * (M_PI / 2 / POLAR) * (2 * M_PI / AROUND);
            sum.white += d * visibility * z * area;
            sum.grazing += d * visibility * z * area * std::pow(1 - out, 5);
        }
    return sum;
}

} // namespace

TEST_CASE("microfacets reflect what their BSDF does") {
    for (const double alpha : {0.1, 0.3, 0.6, 1.0})
        for (const double cosine : {0.1, 0.3, 0.6, 0.99}) {
            INFO("alpha " << alpha << ", cosine " << cosine);
            const ReflectionAlbedo wanted = by_directions(cosine, alpha);
            const ReflectionAlbedo got = reflection_albedo(cosine, alpha);
            CHECK(got.white == Approx(wanted.white).margin(1.5e-3));
            CHECK(got.grazing == Approx(wanted.grazing).margin(5e-4));
        }
}

TEST_CASE("glass that lets nothing through is a mirror") {
    for (const double alpha : {0.2, 0.5, 1.0})
        CHECK(glass_albedo(0.3, alpha, 1e-3).outside ==
              Approx(reflection_albedo(0.3, alpha).white).margin(1e-3));
}

TEST_CASE("between its entries a table is near what it stands for") {
    AlbedoTables tables;
    const uint32_t at = tables.glass(1.5f);
    CHECK(tables.glass(1.5f) == at);
    CHECK(tables.glass(1.3f) == at + ALBEDO_TABLE);
    const std::vector<uint32_t> words = std::move(tables).words();
    REQUIRE(words.size() == GLASS_TABLES + 2 * ALBEDO_TABLE);
    const std::span all(words);
    for (double roughness = 0.03; roughness < 1; roughness += 0.083)
        for (double cosine = 0.01; cosine < 1; cosine += 0.0317) {
            const double alpha = roughness * roughness;
            INFO("roughness " << roughness << ", cosine " << cosine);
            const AlbedoNumbers n = albedo_numbers(all, cosine, alpha);
            const ReflectionAlbedo reflected = reflection_albedo(cosine, alpha);
            CHECK(n.first == Approx(reflected.white).margin(5e-3));
            CHECK(n.first * (std::pow(1 - cosine, 5) + 2 * n.second - 1) ==
                  Approx(reflected.grazing).margin(2e-3));
            const AlbedoNumbers g = albedo_numbers(all.subspan(at), cosine, alpha);
            const GlassAlbedo scattered = glass_albedo(cosine, alpha, 1.5);
            CHECK(g.first == Approx(scattered.outside).margin(1.5e-2));
            CHECK(g.second == Approx(scattered.inside).margin(1.5e-2));
        }
}

TEST_CASE("many kinds of glass share tables, and a scene that asks for none has mirrors") {
    AlbedoTables tables;
    uint32_t last = 0;
    for (int i = 0; i < 500; i++) last = std::max(last, tables.glass(1.0f + 0.01f * float(i)));
    CHECK(last == GLASS_TABLES + 63 * ALBEDO_TABLE);
    CHECK(tables.glass(1.2f) == GLASS_TABLES + 20 * ALBEDO_TABLE);
    const std::vector<uint32_t> unused = AlbedoTables().words();
    REQUIRE(unused.size() == GLASS_TABLES);
    CHECK(albedo_numbers(unused, 0.4, 0.3).first == Approx(1));
    CHECK((unused[ALBEDO_MEANS] & 0xffff) == 0xffff);
}
