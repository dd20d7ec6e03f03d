// The environment map lies where scene.h says: row 0 up, centre column -Z, +X to its right.
#include "support/reference/environment.h"
#include "support/reference/sampling.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::reference;

namespace {

Environment noisy_map(float rotation) {
    Environment environment;
    environment.radiance = glm::vec3(1.0f, 0.5f, 2.0f);
    environment.rotation = rotation;
    environment.map = Image(16, 8, 3);
    for (size_t i = 0; i < environment.map->pixels.size(); ++i)
        environment.map->pixels[i] = i % 7 == 0 ? 5.0f : float(i % 5) * 0.1f;
    return environment;
}

/// A map of one colour but for a red column.
EnvironmentLight with_red_column(uint32_t column, float rotation) {
    Environment environment;
    environment.radiance = glm::vec3(1.0f);
    environment.rotation = rotation;
    environment.map = Image(8, 4, 3);
    for (uint32_t y = 0; y < 4; ++y) environment.map->pixel(column, y)[0] = 1.0f;
    return EnvironmentLight(environment);
}

glm::vec3 direction_of(float degrees_right_of_minus_z) {
    const float phi = degrees_right_of_minus_z * PI / 180.0f;
    return {std::sin(phi), 0.0f, -std::cos(phi)};
}

} // namespace

TEST_CASE("columns right of the centre are toward +X") {
    // The centre of column 6 of 8 is 2.5 / 8 of a turn right of -Z.
    const EnvironmentLight light = with_red_column(6, 0.0f);
    CHECK(light.radiance(direction_of(112.5f)).r == Approx(1.0f));
    CHECK(light.radiance(direction_of(135.0f)).r == Approx(0.5f));
    CHECK(light.radiance(direction_of(-112.5f)).r == Approx(0.0f).margin(1e-6));
}

TEST_CASE("a rotation turns the map counter-clockwise seen from above") {
    const EnvironmentLight light = with_red_column(6, PI / 2.0f);
    CHECK(light.radiance(direction_of(22.5f)).r == Approx(1.0f));
    CHECK(light.radiance(direction_of(112.5f)).r == Approx(0.0f).margin(1e-6));
}

TEST_CASE("columns interpolate across the seam behind +Z") {
    const EnvironmentLight light = with_red_column(7, 0.0f);
    CHECK(light.radiance(direction_of(157.5f)).r == Approx(1.0f));
    CHECK(light.radiance(direction_of(180.0f)).r == Approx(0.5f).margin(1e-3));
    CHECK(light.radiance(direction_of(-157.5f)).r == Approx(0.0f).margin(1e-6));
}

TEST_CASE("row 0 is straight up") {
    Environment environment;
    environment.radiance = glm::vec3(2.0f);
    environment.map = Image(4, 2, 3);
    for (uint32_t x = 0; x < 4; ++x) environment.map->pixel(x, 0)[1] = 3.0f;
    const EnvironmentLight light(environment);
    CHECK(light.radiance({0, 1, 0}).g == Approx(6.0f));
    CHECK(light.radiance({0, -1, 0}).g == Approx(0.0f));
}

TEST_CASE("sampled directions report the density that pdf gives, which integrates to one") {
    const EnvironmentLight light(noisy_map(0.7f));
    Random random(1, 2, 3);
    uint32_t mismatches = 0;
    for (uint32_t i = 0; i < 10000; ++i) {
        const EnvironmentLight::Sample s = light.sample(random);
        mismatches += std::abs(light.pdf(s.direction) / s.pdf - 1.0f) > 1e-3f;
    }
    CHECK(mismatches < 10); // roundings on pixel borders
    double integral = 0.0;
    constexpr uint32_t COUNT = 400000;
    for (uint32_t i = 0; i < COUNT; ++i)
        integral += 4.0 * double(PI) * double(light.pdf(sample_sphere(random.next2()))) / COUNT;
    CHECK(integral == Approx(1.0).epsilon(0.01));
}

TEST_CASE("sampling by the map integrates the same radiance as uniform directions") {
    const EnvironmentLight light(noisy_map(0.0f));
    Random random(4, 5, 6);
    double by_map = 0.0, uniform = 0.0;
    constexpr uint32_t COUNT = 400000;
    for (uint32_t i = 0; i < COUNT; ++i) {
        const EnvironmentLight::Sample s = light.sample(random);
        by_map += double(luminance(light.radiance(s.direction)) / s.pdf) / COUNT;
        uniform += 4.0 * double(PI) *
                   double(luminance(light.radiance(sample_sphere(random.next2())))) / COUNT;
    }
    CHECK(by_map == Approx(uniform).epsilon(0.01));
    CHECK(by_map == Approx(double(light.integral())).epsilon(0.01));
}
