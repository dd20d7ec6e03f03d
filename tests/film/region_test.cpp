// Sets of pixels, compared with plain bitmaps.
#include "film/region.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <random>

namespace onde::test {
namespace {

constexpr uint32_t SIDE = 12;
using Bits = std::array<bool, SIDE * SIDE>;

Bits bits_of(const std::vector<Rectangle>& rectangles) {
    Bits bits{};
    for (const Rectangle& r : rectangles)
        for (uint32_t y = r.y; y < r.end_y(); y++)
            for (uint32_t x = r.x; x < r.end_x(); x++) bits[y * SIDE + x] = true;
    return bits;
}

std::vector<Rectangle> random_rectangles(std::mt19937& generator) {
    std::vector<Rectangle> rectangles(generator() % 5);
    for (Rectangle& r : rectangles) {
        r.x = uint32_t(generator() % SIDE);
        r.y = uint32_t(generator() % SIDE);
        r.width = uint32_t(generator() % (SIDE - r.x + 1));
        r.height = uint32_t(generator() % (SIDE - r.y + 1));
    }
    return rectangles;
}

template <class Keep>
Bits combined(const Bits& a, const Bits& b, Keep keep) {
    Bits bits{};
    for (size_t i = 0; i < bits.size(); i++) bits[i] = keep(a[i], b[i]);
    return bits;
}

} // namespace

TEST_CASE("unions, intersections and differences of regions are those of their pixels") {
    std::mt19937 generator(1);
    for (int trial = 0; trial < 2000; trial++) {
        const auto in_a = random_rectangles(generator), in_b = random_rectangles(generator);
        const Region a(in_a), b(in_b);
        const Bits bits_a = bits_of(in_a), bits_b = bits_of(in_b);
        REQUIRE(bits_of(a.rectangles()) == bits_a);
        REQUIRE(bits_of((a | b).rectangles()) == combined(bits_a, bits_b, std::logical_or()));
        REQUIRE(bits_of((a & b).rectangles()) == combined(bits_a, bits_b, std::logical_and()));
        REQUIRE(bits_of((a - b).rectangles()) ==
                combined(bits_a, bits_b, [](bool x, bool y) { return x && !y; }));
    }
}

TEST_CASE("a set of pixels has one form, whatever it was made from") {
    std::mt19937 generator(2);
    for (int trial = 0; trial < 500; trial++) {
        auto rectangles = random_rectangles(generator);
        const Region region(rectangles);
        uint64_t pixels = 0;
        for (const Rectangle& r : region.rectangles()) pixels += r.pixels();
        REQUIRE(pixels == uint64_t(std::ranges::count(bits_of(rectangles), true)));
        std::ranges::shuffle(rectangles, generator);
        REQUIRE(Region(rectangles) == region);
        REQUIRE(Region(region.rectangles()) == region);
    }
    std::vector<Rectangle> tiles;
    for (uint32_t i = 0; i < 9; i++) tiles.push_back({i % 3 * 4, i / 3 * 4, 4, 4});
    CHECK(Region(tiles).rectangles() == std::vector{Rectangle{0, 0, 12, 12}});
}

} // namespace onde::test
