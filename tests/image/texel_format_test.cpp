// Halves, and what they hold.
#include "image/texel_format.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace onde;

namespace {

/// By the standard's definition.
float number_of(uint32_t half) {
    const uint32_t exponent = half >> 10, digits = half & 1023;
    if (exponent == 0) return std::ldexp(float(digits), -24);
    return std::ldexp(float(1024 + digits), int(exponent) - 25);
}

constexpr uint32_t INFINITY_CODE = 0x7c00;

TexelImage floats(std::vector<float> samples) {
    TexelImage image;
    image.width = uint32_t(samples.size() / 4);
    image.height = 1;
    image.floats = std::move(samples);
    return image;
}

} // namespace

TEST_CASE("every half is exact, and nearest to itself") {
    for (uint32_t half = 0; half < INFINITY_CODE; ++half) {
        REQUIRE(exact_half(number_of(half)) == uint16_t(half));
        REQUIRE(nearest_half(number_of(half)) == number_of(half));
    }
}

TEST_CASE("numbers between halves have no exact one, and the nearer one is nearest") {
    for (uint32_t half = 1; half + 1 < INFINITY_CODE; half += 7) {
        const float low = number_of(half), high = number_of(half + 1);
        REQUIRE(nearest_half(low + 0.25f * (high - low)) == low);
        REQUIRE(nearest_half(low + 0.75f * (high - low)) == high);
        const bool tiny = half < 1024; // where half a step may be lost
        REQUIRE(exact_half(low + 0.25f * (high - low)).has_value() == tiny);
    }
    CHECK_FALSE(exact_half(65505.0f));
    CHECK(nearest_half(1e30f) == 65504.0f);
}

TEST_CASE("a picture's texels take as many words as its samples need") {
    TexelImage codes{2, 3, std::vector<uint8_t>(24)};
    CHECK(device_bytes(codes) == 24);
    codes.low = codes.rgba;
    CHECK(device_bytes(codes) == 48);
    CHECK(texel_format(floats({50.0f, 0.5f, 0.0f, 1.0f})) == TexelFormat::halves);
    CHECK(device_bytes(floats({50.0f, 0.5f, 0.0f, 1.0f})) == 8);
    CHECK(texel_format(floats({0.1f, 0.5f, 0.0f, 1.0f})) == TexelFormat::floats);
    CHECK(device_bytes(floats({1e6f, 0.5f, 0.0f, 1.0f})) == 16);
}
