#include "image/tone.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace onde;

namespace {
constexpr float INF = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
} // namespace

TEST_CASE("the sRGB curve goes through the points of its standard") {
    CHECK(srgb_from_linear(0.0f) == 0.0f);
    CHECK(srgb_from_linear(1.0f) == Approx(1.0f).epsilon(1e-6));
    CHECK(srgb_from_linear(0.002f) == Approx(0.02584f).epsilon(1e-6)); // linear toe
    CHECK(srgb_from_linear(0.18f) == Approx(0.461356f).epsilon(1e-5));
    CHECK(srgb_from_linear(0.5f) == Approx(0.735357f).epsilon(1e-5));
    CHECK(linear_from_srgb(0.5f) == Approx(0.214041f).epsilon(1e-5));
    CHECK(linear_from_srgb(0.02f) == Approx(0.02f / 12.92f).epsilon(1e-6));
}

TEST_CASE("every 8-bit sRGB value survives a trip through linear light") {
    for (int code = 0; code < 256; ++code) {
        Image pixel(1, 1, 1);
        pixel.pixels[0] = linear_from_srgb(float(code) / 255);
        INFO("code " << code);
        CHECK(int(display_bytes(pixel, {})[0]) == code);
    }
}

TEST_CASE("the filmic curve rises from black to a shoulder below white") {
    CHECK(filmic(0.0f) == 0.0f);
    CHECK(filmic(-1.0f) == 0.0f);
    CHECK(filmic(1.0f) == Approx(2.54f / 3.16f).epsilon(1e-6));
    CHECK(filmic(INF) == 1.0f);
    float previous = 0;
    for (int step = 1; step <= 1000; ++step) {
        const float value = filmic(float(step) * 0.01f);
        INFO("at " << float(step) * 0.01f);
        REQUIRE(value >= previous);
        REQUIRE(value <= 1.0f);
        previous = value;
    }
}

TEST_CASE("one stop of exposure doubles the light and leaves alpha alone") {
    Image dim(1, 1, 4), bright(1, 1, 4);
    dim.pixels = {0.1f, 0.2f, 0.3f, 0.25f};
    bright.pixels = {0.2f, 0.4f, 0.6f, 0.25f};
    CHECK(display_bytes(dim, {1.0f, ToneMap::none}) == display_bytes(bright, {}));
    CHECK(int(display_bytes(dim, {1.0f, ToneMap::filmic})[3]) == 64);
}

TEST_CASE("values a display cannot show are clipped, and NaN is black") {
    Image image(4, 1, 1);
    image.pixels = {-1.0f, 7.0f, INF, NOT_A_NUMBER};
    CHECK(display_bytes(image, {}) == std::vector<uint8_t>{0, 255, 255, 0});
    CHECK(display_bytes(image, {0.0f, ToneMap::filmic})[3] == 0);
}
