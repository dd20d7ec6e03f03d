#include "film/assembly.h"

#include <algorithm>

namespace onde {
namespace {

/// Copies the pixels of a rectangle, plane by plane.
void copy_pixels(const FilmContents& film, const Rectangle& part, const FilmSums& from,
                 FilmSums& to) {
    for (uint32_t plane = 0; plane < film.planes.count(); plane++)
        for (uint32_t y = part.y; y < part.end_y(); y++) {
            const auto first = ptrdiff_t((size_t(plane) * film.height + y) * film.width + part.x);
            std::copy_n(from.begin() + first, part.width, to.begin() + first);
        }
}

void copy_ids(uint32_t width, const Rectangle& part, const IdCounts& from, IdCounts& to) {
    if (from.empty()) return;
    to.resize(from.size());
    for (uint32_t y = part.y; y < part.end_y(); y++) {
        const auto first = ptrdiff_t(size_t(y) * width + part.x);
        std::copy_n(from.begin() + first, part.width, to.begin() + first);
    }
}

} // namespace

FilmAssembly::FilmAssembly(FilmContents begun, const Rectangle& window)
    : contents_(std::move(begun)), window_(window) {}

void FilmAssembly::add(const Rectangle& part, const FilmContents& unit) {
    Block& block = blocks_[unit.extent.begin / FILM_BLOCK];
    if (block.sums.empty())
        block = {FilmSums(contents_.block.size()), window_.pixels(),
                 unit.extent.end - unit.extent.begin};
    copy_pixels(contents_, part, unit.parts.empty() ? unit.block : unit.parts.front().sums,
                block.sums);
    copy_ids(contents_.width, part, unit.ids, block.ids);
    block.missing -= part.pixels();
    for (auto next = blocks_.begin(); next != blocks_.end() && next->second.missing == 0 &&
                                      next->first * FILM_BLOCK == contents_.extent.end;
         next = blocks_.erase(next))
        append(std::move(next->second));
}

void FilmAssembly::append(Block block) {
    const uint32_t index = contents_.extent.end / FILM_BLOCK;
    contents_.extent.end += block.samples;
    for (size_t i = 0; i < block.ids.size(); i++)
        for (const IdCount& seen : block.ids[i]) add_id(contents_.ids[i], seen.id, seen.count);
    if (block.samples == FILM_BLOCK)
        add_part(contents_.parts, {{0, index}, std::move(block.sums)});
    else
        contents_.block = std::move(block.sums);
}

} // namespace onde
