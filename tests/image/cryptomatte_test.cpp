#include "image/cryptomatte.h"

#include <catch2/catch.hpp>

#include <bit>

namespace onde::test {

TEST_CASE("names are hashed as Cryptomatte wants them") {
    CHECK(murmur_hash("") == 0);
    CHECK(murmur_hash("hello") == 0x248bfa47);
    CHECK(murmur_hash("hello, world") == 0x149bbb7f);
    CHECK(murmur_hash("The quick brown fox jumps over the lazy dog") == 0x2e4ff723);
    for (uint32_t i = 0; i < 4000; i++) { // of which some 30 need another exponent
        const uint32_t id = cryptomatte_id("name " + std::to_string(i)), exponent = id >> 23 & 255;
        CHECK((exponent != 0 && exponent != 255));
    }
    CHECK(cryptomatte_id("") == 1u << 23);
}

TEST_CASE("the names of a pixel are ranked by their shares") {
    NamedCounts counts{2, 1, {"a", "b", "c"}, {{{0, 2}, {1, 5}, {2, 3}}, {}}, {12, 12}};
    const std::vector<ExrLayer> layers = cryptomatte_layers(counts, "Crypto");
    REQUIRE(layers.size() == 2);
    CHECK(layers[0].names ==
          std::vector<std::string>{"Crypto00.R", "Crypto00.G", "Crypto00.B", "Crypto00.A"});
    const std::vector<float>& first = layers[0].image.pixels;
    CHECK(std::bit_cast<uint32_t>(first[0]) == cryptomatte_id("b"));
    CHECK(first[1] == 5 / 12.0f);
    CHECK(std::bit_cast<uint32_t>(first[2]) == cryptomatte_id("c"));
    CHECK(std::bit_cast<uint32_t>(layers[1].image.pixels[0]) == cryptomatte_id("a"));
    CHECK(layers[1].image.pixels[1] == 2 / 12.0f);
    CHECK(first[5] == 0); // the second pixel shows nothing
    const ImageMetadata metadata = cryptomatte_metadata(counts, "Crypto");
    REQUIRE(metadata.size() == 4);
    CHECK(metadata.begin()->first.starts_with("cryptomatte/"));
    CHECK(metadata.begin()->first.find('/', 12) == 12 + 7);
}

TEST_CASE("of a pixel that shows too many things the smallest shares are left out") {
    NamedCounts counts{1, 1, {}, {{}}, {1000}};
    for (uint32_t i = 0; i < 40; i++) {
        counts.names.push_back("thing " + std::to_string(i));
        counts.pixels[0].push_back({i, i + 1});
    }
    const std::vector<ExrLayer> layers = cryptomatte_layers(counts, "C");
    CHECK(layers.size() == MOST_RANKS / 2);
    CHECK(layers[0].image.pixels[1] == 40 / 1000.0f);
    CHECK(layers.back().image.pixels[3] == 25 / 1000.0f);
}

} // namespace onde::test
