// What the values of an enum are called in scene files, on the command line and in reports: one
// table, in a function beside the enum, from which all of them read.
//
//     enum class Wrap { repeat, clamp };
//     constexpr auto enum_words(Wrap) {
//         return std::array{EnumWord{Wrap::repeat, "repeat"}, EnumWord{Wrap::clamp, "clamp"}};
//     }
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace onde {

/// A value and its word: lower case, with dashes.
template <class Enum>
struct EnumWord {
    Enum value;
    std::string_view word;
};
template <class Enum>
EnumWord(Enum, std::string_view) -> EnumWord<Enum>;

/// An enum with a table of words.
template <class Enum>
concept WordedEnum = std::is_enum_v<Enum> && requires {
    enum_words(Enum{});
};

namespace enum_words_detail {

constexpr size_t MOST_VALUES = 32;

/// Whether an enumerator has the value. GCC and clang print its name then, and a cast otherwise:
/// "[with auto VALUE = onde::Wrap::clamp]" and "[with auto VALUE = (onde::Wrap)7]".
template <auto VALUE>
consteval bool is_enumerator() {
    constexpr std::string_view text = __PRETTY_FUNCTION__;
    return text[text.rfind("VALUE = ") + 8] != '(';
}

/// The enumerators among the values below MOST_VALUES.
template <class Enum>
consteval size_t count_enumerators() {
    return []<size_t... I>(std::index_sequence<I...>) {
        return (size_t(is_enumerator<Enum(I)>()) + ...);
    }
    (std::make_index_sequence<MOST_VALUES>());
}

template <class Words>
constexpr bool are_distinct(const Words& words) {
    for (size_t i = 0; i < words.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            if (words[i].word == words[j].word || words[i].value == words[j].value) return false;
    return true;
}

template <class Words>
constexpr bool are_plain(const Words& words) {
    return std::ranges::all_of(words, [](const auto& line) {
        return !line.word.empty() && std::ranges::all_of(line.word, [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
        });
    });
}

template <WordedEnum Enum>
consteval auto checked_words() {
    constexpr auto words = enum_words(Enum{});
    static_assert(words.size() == count_enumerators<Enum>(), "an enumerator has no word");
    static_assert(are_distinct(words), "a word or an enumerator is listed twice");
    static_assert(are_plain(words), "a word is not of lower case letters, digits and dashes");
    return words;
}

} // namespace enum_words_detail

/// The enum's table. It does not compile unless it lists each enumerator once, by its own word.
template <WordedEnum Enum>
inline constexpr auto WORDS_OF = enum_words_detail::checked_words<Enum>();

/// The word of an enumerator.
template <WordedEnum Enum>
constexpr std::string_view word_of(Enum value) {
    for (const EnumWord<Enum>& line : WORDS_OF<Enum>)
        if (line.value == value) return line.word;
    return {};
}

/// The enumerator of a word, or nothing for any other text.
template <WordedEnum Enum>
constexpr std::optional<Enum> value_of(std::string_view word) {
    for (const EnumWord<Enum>& line : WORDS_OF<Enum>)
        if (line.word == word) return line.value;
    return std::nullopt;
}

/// The words alone, in the table's order.
template <WordedEnum Enum>
std::vector<std::string_view> all_words() {
    std::vector<std::string_view> words;
    for (const EnumWord<Enum>& line : WORDS_OF<Enum>) words.push_back(line.word);
    return words;
}

} // namespace onde
