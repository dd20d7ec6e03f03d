// The extensions of glTF that Onde knows by name, and what it makes of them: the one list.
#pragma once

#include <span>
#include <string_view>

namespace onde::gltf {

enum class Support {
    read,    ///< as its specification says
    mapped,  ///< to what Onde has; a note says so where it matters
    ignored, ///< with a note, even if the file requires it: the picture keeps its meaning
    none     ///< ignored with a note; a file that requires it is refused
};

struct Extension {
    std::string_view name;
    Support support;
    std::string_view remark{}; ///< for the documentation
};

/// All known ones by name; others have no support.
std::span<const Extension> known_extensions();

/// "read", "ignored, with a note", ...
std::string_view meaning_of(Support support);

Support support_of(std::string_view name);

constexpr bool is_understood(Support support) {
    return support == Support::read || support == Support::mapped;
}

} // namespace onde::gltf
