// Measures how deep a TOML text nests, before a parser recurses into it.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace onde {

/// The first line, counted from 1, that has a key of more than `most` parts, or brackets and braces
/// opened more than `most` deep, outside of texts and comments. Nothing when there is none.
std::optional<size_t> line_nested_deeper(std::string_view toml, size_t most);

} // namespace onde
