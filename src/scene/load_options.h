// What a user may ask of a load, whatever the format. Every command that loads a scene shares it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace onde {

struct LoadOptions {
    bool strict = false;          ///< refuse what would be repaired or dropped with a note
    std::filesystem::path root{}; ///< folder that references may not leave; empty: the file's own
    uint64_t limit = 0;           ///< bytes that a whole load may take; 0: a quarter of the memory

    // Of glTF files; a name, or a number from 0. Empty: the default.
    std::optional<double> at{}; ///< seconds of the animation; else the rest pose
    std::string animation{}, scene{}, variant{};
};

} // namespace onde
