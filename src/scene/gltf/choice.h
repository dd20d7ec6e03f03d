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

/// "0 'walk', 1 without a name", at most eight.
template <class T>
std::string names_of(const std::vector<T>& things) {
    constexpr size_t MOST = 8;
    std::string text;
    for (size_t i = 0; i < std::min(things.size(), MOST); ++i) {
        if (i > 0) text += ", ";
        text += std::to_string(i);
        const std::string& name = name_of(things[i]);
        text += name.empty() ? " without a name" : " '" + shown(name, 40) + "'";
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
    if (things.empty())
        throw InputError("{}: it has no {}s, so none is '{}'; leave {} away", file.name, kind,
                         shown(word), option);
    throw InputError("{}: it has no {} '{}' for {}; those that it has, by number: {}", file.name,
                     kind, shown(word), option, names_of(things));
}

} // namespace onde::gltf
