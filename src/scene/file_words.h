// The words that a format's files are made of, for the tables of docs/scene-format.md.
#pragma once

#include <string_view>
#include <vector>

namespace onde {

/// A word that the reader of a format knows, and what becomes of it. Words that follow each other
/// and become the same share a row of the table.
struct FileWord {
    std::string_view word, becomes;
};

inline constexpr std::string_view NOTED = "ignored, with a note";

namespace mtl {
std::vector<FileWord> statement_words();  ///< of MTL files
std::vector<FileWord> map_option_words(); ///< of maps in MTL files
} // namespace mtl

namespace ply {
std::vector<FileWord> element_words();  ///< elements that are read
std::vector<FileWord> property_words(); ///< of those
} // namespace ply

namespace pbrt {
std::vector<FileWord> directive_words(); ///< of pbrt files
std::vector<FileWord> material_words();  ///< kinds of materials in them
} // namespace pbrt

namespace mitsuba {
std::vector<FileWord> plugin_words(); ///< plugins of Mitsuba's files
} // namespace mitsuba

} // namespace onde
