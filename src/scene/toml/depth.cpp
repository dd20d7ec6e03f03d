#include "scene/toml/depth.h"

#include <algorithm>

namespace onde {

namespace {

/// The length of the text in quotes that begins here, quotes included. One without an end goes on
/// to the end of its line, or of the file where it may hold lines.
size_t quoted_length(std::string_view toml) {
    const char quote = toml[0];
    const bool lines = toml.size() > 2 && toml[1] == quote && toml[2] == quote;
    const std::string_view closing = toml.substr(0, lines ? 3 : 1);
    size_t i = closing.size();
    while (i < toml.size() && (lines || toml[i] != '\n')) {
        if (toml.substr(i, closing.size()) == closing) {
            // Up to two more quotes belong to a text of lines.
            const std::string_view more = toml.substr(i + closing.size(), lines ? 2 : 0);
            return i + closing.size() + std::min(more.find_first_not_of(quote), more.size());
        }
        i += quote == '"' && toml[i] == '\\' ? 2 : 1;
    }
    return std::min(i, toml.size());
}

} // namespace

std::optional<size_t> line_nested_deeper(std::string_view toml, size_t most) {
    size_t line = 1, parts = 1, depth = 0;
    for (size_t i = 0; i < toml.size();) {
        size_t length = 1;
        const char c = toml[i];
        if (c == '"' || c == '\'')
            length = quoted_length(toml.substr(i));
        else if (c == '#')
            length = std::min(toml.find('\n', i), toml.size()) - i;
        else if (c == '[' || c == '{')
            ++depth;
        else if ((c == ']' || c == '}') && depth > 0)
            --depth;
        if (c == '.')
            ++parts;
        else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos)
            parts = 1; // a key ends here
        if (parts > most || depth > most) return line;
        line += size_t(std::ranges::count(toml.substr(i, length), '\n'));
        i += length;
    }
    return std::nullopt;
}

} // namespace onde
