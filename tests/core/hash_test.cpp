#include "core/hash.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace onde;

TEST_CASE("the hash of nothing is XXH3's") {
    CHECK(Hasher().hex() == "2d06800538d394c2");
}

TEST_CASE("a hash is 16 hexadecimal digits, whatever its leading zeros") {
    for (uint32_t i = 0; i < 1000; ++i) REQUIRE(Hasher().value(i).hex().size() == 16);
}

TEST_CASE("equal calls give equal hashes, other orders give others") {
    CHECK(Hasher().value(1).value(2).digest() == Hasher().value(1).value(2).digest());
    CHECK(Hasher().value(1).value(2).digest() != Hasher().value(2).value(1).digest());
}

TEST_CASE("texts and spans are hashed with their length") {
    CHECK(Hasher().text("ab").text("c").digest() != Hasher().text("a").text("bc").digest());
    const std::vector<int> one = {1}, two = {2}, both = {1, 2}, none;
    CHECK(Hasher().span(std::span(one)).span(std::span(two)).digest() !=
          Hasher().span(std::span(both)).span(std::span(none)).digest());
}

TEST_CASE("bytes may come in pieces") {
    CHECK(Hasher().bytes("abcd", 4).digest() == Hasher().bytes("ab", 2).bytes("cd", 2).digest());
}
