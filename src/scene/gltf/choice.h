// The user's choice among named things of a file: scenes, animations, variants.
#pragma once

#include "core/error.h"
#include "core/shown.h"
#include "scene/gltf/file.h"

#include <charconv>

namespace onde::gltf {

inline const std::string& name_of(const std::string& name) {
    return name;
}
template <class T>
const std::string& name_of(const T& thing) {
    return thing.name;
}

/// "0 'walk', 1 'run'", at most eight.
template <class T>
std::string names_of(const std::vector<T>& things) {
    constexpr size_t MOST = 8;
    std::string text;
    for (size_t i = 0; i < std::min(things.size(), MOST); ++i) {
        if (i > 0) text += ", ";
        text += std::to_string(i);
        if (!name_of(things[i]).empty()) text += " '" + shown(name_of(things[i]), 40) + "'";
    }
    return things.size() > MOST ? text + ", ..." : text;
}

/// The index of what `word`, the value of `option`, names, or counts from 0. Throws InputError
/// where there is none.
template <class T>
size_t choose(const File& file, const std::vector<T>& things, const std::string& word,
              const char* option, const char* kind) {
    for (size_t i = 0; i < things.size(); ++i)
        if (name_of(things[i]) == word) return i;
    size_t index = 0;
    const char* const end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(word.data(), end, index);
    if (error == std::errc() && rest == end && index < things.size()) return index;
    throw InputError("{}: it has no {} '{}' for {}; there {}", file.name, kind, shown(word), option,
                     things.empty() ? "is none" : "are " + names_of(things));
}

} // namespace onde::gltf
