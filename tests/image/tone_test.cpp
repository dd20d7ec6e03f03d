#include "image/tone.h"

#include <catch2/catch.hpp>

#include <cmath>
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

TEST_CASE("the neutral tone map keeps colours below its shoulder but for what surfaces reflect") {
    for (const float least : {0.08f, 0.3f})
        for (const float largest : {0.35f, 0.79f}) {
            const glm::vec3 shown = neutral({least, 0.5f * (least + largest), largest});
            CHECK(shown.x == Approx(least - 0.04f));
            CHECK(shown.y == Approx(0.5f * (least + largest) - 0.04f));
            CHECK(shown.z == Approx(largest - 0.04f));
        }
    CHECK(neutral(glm::vec3(0.04f)).x == Approx(6.25f * 0.04f * 0.04f));
    CHECK(neutral(glm::vec3(0)) == glm::vec3(0));
}

TEST_CASE("the neutral tone map compresses what is bright, and lets it fade to white") {
    const glm::vec3 bright = neutral({3.0f, 0.1f, 0.1f}), brighter = neutral({50.0f, 0.1f, 0.1f});
    CHECK(bright.x == Approx(1 - 0.24f * 0.24f / (2.96f + 0.24f - 0.76f)));
    CHECK(bright.y == bright.z); // the hue stays
    CHECK(brighter.y > bright.y);
    CHECK(brighter.x < 1.0f);
    CHECK(neutral({INF, 0, 0}) == glm::vec3(1));
    CHECK(neutral({NOT_A_NUMBER, -1, 0}) == glm::vec3(0));
}

TEST_CASE(
    "AgX shows middle grey as the encoded half that its curve turns about, and fades colours") {
    CHECK(srgb_from_linear(agx(glm::vec3(0.18f)).x) == Approx(0.5f).margin(0.01));
    CHECK(agx(glm::vec3(0)).x == Approx(0.0f).margin(1e-4));
    CHECK(agx(glm::vec3(20)).x == Approx(1.0f).margin(0.01));
    CHECK(agx({INF, INF, INF}).x <= 1.0f);
    const glm::vec3 blue = agx({0, 0, 10});
    CHECK(blue.x > 0.2f);
    CHECK(blue.z > blue.x);
    float previous = -1;
    for (int step = 0; step < 200; ++step) {
        const float value = agx(glm::vec3(std::exp2(float(step) * 0.1f - 13))).y;
        REQUIRE(value >= previous);
        previous = value;
    }
}

TEST_CASE("a tone map of colours takes a picture's channels together") {
    Image red(1, 1, 3), grey(1, 1, 1);
    red.pixels = {50.0f, 0.1f, 0.1f};
    grey.pixels = {0.5f};
    CHECK(display_bytes(red, {0.0f, ToneMap::neutral})[1] > display_bytes(red, {})[1]);
    CHECK(display_bytes(grey, {0.0f, ToneMap::neutral})[0] < display_bytes(grey, {})[0]);
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
