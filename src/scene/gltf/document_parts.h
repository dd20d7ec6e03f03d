// What the readers of a glTF document share. Only they include it.
#pragma once

#include "scene/gltf/document.h"

#include <algorithm>
#include <limits>

namespace onde::gltf {

inline constexpr uint64_t MAX_SIZE = std::numeric_limits<uint64_t>::max();

inline std::string name_in(const JsonReader& object) {
    return object.text("name").value_or("");
}

inline uint32_t required_index(const JsonReader& object, const char* key) {
    return object.require(key, object.index(key));
}

/// The value of an enum by the place of its word in a list.
template <class Enum, size_t N>
Enum word_in(const JsonReader& object, const char* key, const std::array<const char*, N>& words,
             std::optional<std::string> word) {
    const std::string given = object.require(key, std::move(word));
    const auto found = std::ranges::find(words, given);
    if (found == words.end()) object.fail(key, "is a word that glTF does not know");
    return Enum(found - words.begin());
}

template <class T>
std::vector<T> read_list(const JsonReader& object, const char* key, T (*read)(const JsonReader&)) {
    std::vector<T> list;
    for (const JsonReader& element : object.objects(key)) list.push_back(read(element));
    return list;
}

Attributes read_attributes(const JsonReader& object);

/// Buffers, views, accessors, images, samplers, textures: what other things are made of.
void read_data(const JsonReader& root, Document& document);

/// Skins and animations.
void read_poses(const JsonReader& root, Document& document);

} // namespace onde::gltf
