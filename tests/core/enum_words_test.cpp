// One table of words for each enum.
#include "core/enum_words.h"

#include <catch2/catch.hpp>

namespace onde {
namespace {

enum class Wave { short_wave, long_wave };

constexpr auto enum_words(Wave) {
    return std::array{EnumWord{Wave::long_wave, "long-wave"},
                      EnumWord{Wave::short_wave, "short-wave"}};
}

/// An enum without words.
enum class Silent { a };

static_assert(WordedEnum<Wave> && !WordedEnum<Silent>);
static_assert(enum_words_detail::count_enumerators<Wave>() == 2);
static_assert(enum_words_detail::count_enumerators<Silent>() == 1);

constexpr bool distinct(std::array<EnumWord<Wave>, 2> words) {
    return enum_words_detail::are_distinct(words);
}
constexpr bool plain(std::string_view word) {
    return enum_words_detail::are_plain(std::array{EnumWord{Wave::long_wave, word}});
}

} // namespace

TEST_CASE("an enumerator and its word are found by each other, in the table's order") {
    CHECK(word_of(Wave::short_wave) == "short-wave");
    CHECK(value_of<Wave>("long-wave") == Wave::long_wave);
    CHECK_FALSE(value_of<Wave>("long_wave"));
    CHECK_FALSE(value_of<Wave>(""));
    CHECK(all_words<Wave>() == std::vector<std::string_view>{"long-wave", "short-wave"});
}

TEST_CASE("a table that lists a word or a value twice, or an odd word, is no table") {
    CHECK(distinct({{{Wave::long_wave, "a"}, {Wave::short_wave, "b"}}}));
    CHECK_FALSE(distinct({{{Wave::long_wave, "a"}, {Wave::short_wave, "a"}}}));
    CHECK_FALSE(distinct({{{Wave::long_wave, "a"}, {Wave::long_wave, "b"}}}));
    CHECK(plain("depth-buffer2"));
    for (const char* odd : {"", "Depth", "depth_buffer", "depth buffer"}) CHECK_FALSE(plain(odd));
}

} // namespace onde
