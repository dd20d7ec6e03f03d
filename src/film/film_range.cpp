#include "film/film_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace onde {

std::optional<FilmNode> FilmRange::node() const {
    if (pass > 0 || count % FILM_BLOCK != 0 || first % FILM_BLOCK != 0) return std::nullopt;
    const uint32_t blocks = count / FILM_BLOCK, begin = first / FILM_BLOCK;
    if (!std::has_single_bit(blocks) || begin % blocks != 0) return std::nullopt;
    const auto level = uint32_t(std::countr_zero(blocks));
    return FilmNode{level, begin >> level};
}

FilmRange range_of(const FilmNode& node, const Rectangle& window) {
    return {.window = window,
            .first = uint32_t(node.first_block() * FILM_BLOCK),
            .count = FILM_BLOCK << node.level};
}

Rectangle ids_window(std::span<const FilmRange> parts) {
    Rectangle all = parts.front().window;
    for (const FilmRange& part : parts) {
        const uint32_t end_x = std::max(all.end_x(), part.window.end_x());
        const uint32_t end_y = std::max(all.end_y(), part.window.end_y());
        all.x = std::min(all.x, part.window.x);
        all.y = std::min(all.y, part.window.y);
        all.width = end_x - all.x;
        all.height = end_y - all.y;
    }
    return all;
}

std::string words_of(const FilmRange& range) {
    return fmt::format("samples {} to {} of {}x{} pixels from {},{}", range.first,
                       range.end() + (range.pass > 0 ? range.pass : 0) - 1, range.window.width,
                       range.window.height, range.window.x, range.window.y);
}

} // namespace onde
