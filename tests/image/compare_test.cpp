#include "image/compare.h"

#include "core/error.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace onde;

namespace {

Image grey(uint32_t width, uint32_t height, float value, uint32_t channels = 3) {
    Image image(width, height, channels);
    for (float& sample : image.pixels) sample = value;
    return image;
}

} // namespace

TEST_CASE("a picture compared with itself has no error and infinite PSNR") {
    const Image image = grey(5, 3, 0.7f);
    const Metrics metrics = compare(image, image);
    CHECK(metrics.rmse == 0);
    CHECK(metrics.relative_mse == 0);
    CHECK(metrics.max_error == 0);
    CHECK(std::isinf(metrics.psnr));
    CHECK(metrics.pixels == 15);
    CHECK(metrics.mean_a == Approx(0.7f));
}

TEST_CASE("a constant offset gives the closed forms of every metric") {
    const Metrics metrics = compare(grey(8, 8, 0.75f), grey(8, 8, 0.5f));
    CHECK(metrics.rmse == Approx(0.25));
    CHECK(metrics.relative_mse == Approx(0.0625 / 0.26));
    CHECK(metrics.psnr == Approx(20 * std::log10(4.0)));
    CHECK(metrics.max_error == Approx(0.25));
    CHECK(metrics.mean_a == Approx(0.75));
    CHECK(metrics.mean_b == Approx(0.5));
}

TEST_CASE("the relative error is relative to the second picture") {
    const Image dark = grey(1, 1, 0.0f), bright = grey(1, 1, 1.0f);
    CHECK(compare(bright, dark).relative_mse == Approx(1 / 0.01));
    CHECK(compare(dark, bright).relative_mse == Approx(1 / 1.01));
}

TEST_CASE("one wrong sample is found with its place and both values") {
    const Image a = grey(7, 5, 0.5f);
    Image b = a;
    b.pixel(3, 2)[1] = 0.9f;
    b.pixel(6, 4)[0] = 0.6f;
    const Metrics metrics = compare(a, b);
    CHECK(metrics.worst.x == 3);
    CHECK(metrics.worst.y == 2);
    CHECK(metrics.worst.channel == 1);
    CHECK(metrics.worst.a == 0.5f);
    CHECK(metrics.worst.b == 0.9f);
    CHECK(metrics.rmse == Approx(std::sqrt((0.16 + 0.01) / 105)));
}

TEST_CASE("pixels that are not finite are counted and left out") {
    Image a = grey(2, 2, 0.5f), b = grey(2, 2, 0.25f);
    a.pixel(0, 0)[2] = std::numeric_limits<float>::quiet_NaN();
    b.pixel(0, 0)[1] = std::numeric_limits<float>::infinity();
    b.pixel(1, 1)[0] = -std::numeric_limits<float>::infinity();
    const Metrics metrics = compare(a, b);
    CHECK(metrics.non_finite_a == 1);
    CHECK(metrics.non_finite_b == 2);
    CHECK(metrics.pixels == 2);
    CHECK(metrics.rmse == Approx(0.25));
}

TEST_CASE("pictures without a finite pixel in common are no match") {
    const Image nothing = grey(2, 2, std::numeric_limits<float>::quiet_NaN());
    const Metrics metrics = compare(nothing, nothing);
    CHECK(metrics.pixels == 0);
    CHECK(std::isnan(metrics.rmse));
    CHECK(std::isnan(metrics.psnr));
    CHECK(std::isnan(metrics.max_error));
}

TEST_CASE("pictures of different shape are refused") {
    CHECK_THROWS_AS(compare(grey(2, 3, 0), grey(3, 2, 0)), InputError);
    CHECK_THROWS_AS(compare(grey(2, 2, 0, 3), grey(2, 2, 0, 4)), InputError);
    CHECK_THROWS_AS(difference_image(grey(2, 2, 0), grey(2, 1, 0)), InputError);
}

TEST_CASE("the difference image is absolute and opaque") {
    const Image difference = difference_image(grey(2, 1, 0.25f, 4), grey(2, 1, 0.75f, 4));
    CHECK(difference.pixels == std::vector<float>{0.5f, 0.5f, 0.5f, 1, 0.5f, 0.5f, 0.5f, 1});
}

TEST_CASE("pixels off by more than their noise fail the test of noise, and no others") {
    const uint32_t samples = 100;
    const Image reference = grey(10, 10, 0.5f), variance = grey(10, 10, 0.04f); // sigma 0.02
    CHECK(share_within_noise(reference, reference, variance, samples) == 1.0);
    CHECK(share_within_noise(grey(10, 10, 0.56f), reference, variance, samples) == 1.0);
    // One of a hundred pixels exceeds 3.89 sigma in 1 % of all pictures.
    CHECK(share_within_noise(grey(10, 10, 0.5f + 3.85f * 0.02f), reference, variance, samples) ==
          1.0);
    CHECK(share_within_noise(grey(10, 10, 0.5f + 3.93f * 0.02f), reference, variance, samples) ==
          0.0);
    Image one = reference;
    one.pixels[7] = 1.0f;
    CHECK(share_within_noise(one, reference, variance, samples) == Approx(299.0 / 300.0));
    one.pixels[7] = std::nanf("");
    CHECK(share_within_noise(one, reference, variance, samples) == Approx(299.0 / 300.0));
    CHECK_THROWS_AS(share_within_noise(reference, reference, grey(9, 10, 0.04f), samples),
                    InputError);
}
