// Whole films in and out of files.
#include "core/error.h"
#include "film/film_file.h"

#include <algorithm>

namespace onde {
namespace {

/// The ranges of a film, and their sums.
struct Pieces {
    std::vector<FilmRange> ranges;
    std::vector<const FilmSums*> sums;
};

Pieces pieces_of(const KeptFilm& film) {
    const FilmExtent& extent = film.contents.extent;
    Pieces pieces;
    for (const FilmPart& part : film.contents.parts) {
        pieces.ranges.push_back(range_of(part.node, film.window));
        pieces.sums.push_back(&part.sums);
    }
    const uint32_t in_block = extent.end % FILM_BLOCK;
    const bool is_in_pass = extent.pass > 0 && extent.pixels > 0;
    if (in_block == 0 && !is_in_pass) return pieces;
    pieces.ranges.push_back({.window = film.window,
                             .first = extent.end - in_block,
                             .count = in_block,
                             .pass = is_in_pass ? extent.pass : 0,
                             .pass_pixels = is_in_pass ? extent.pixels : 0});
    pieces.sums.push_back(&film.contents.block);
    return pieces;
}

/// Calls row(y, sums) with the window's pixels of a film's sums, plane after plane.
template <class Row>
void for_each_row(const KeptFilm& film, const FilmSums& sums, const Row& row) {
    const uint32_t width = film.contents.width, planes = film.contents.planes.count();
    FilmRow pixels(size_t(planes) * film.window.width);
    for (uint32_t y = film.window.y; y < film.window.end_y(); y++) {
        for (uint32_t plane = 0; plane < planes; plane++) {
            const size_t first = (size_t(plane) * film.contents.height + y) * width + film.window.x;
            std::copy_n(sums.begin() + ptrdiff_t(first), film.window.width,
                        pixels.begin() + ptrdiff_t(plane * film.window.width));
        }
        row(y, pixels);
    }
}

void write_ids(const KeptFilm& film, FilmWriter& file) {
    const Rectangle& window = film.window;
    for (uint32_t y = window.y; y < window.end_y() && !film.contents.ids.empty(); y++)
        file.write_ids(y, std::span(film.contents.ids)
                              .subspan(size_t(y) * film.contents.width + window.x, window.width));
}

void read_ids(FilmReader& file, KeptFilm& film) {
    if (!file.ids_window()) return;
    file.check_ids();
    FilmContents& contents = film.contents;
    contents.ids.resize(size_t(contents.width) * contents.height);
    std::vector<PixelIds> row;
    for (uint32_t y = film.window.y; y < film.window.end_y(); y++) {
        file.read_ids(y, row);
        std::ranges::move(row, contents.ids.begin() +
                                   ptrdiff_t(size_t(y) * contents.width + film.window.x));
    }
}

FilmSums read_sums(FilmReader& file, size_t part, const KeptFilm& film) {
    const uint32_t width = film.contents.width, planes = film.contents.planes.count();
    FilmSums sums(size_t(planes) * film.contents.height * width);
    FilmRow pixels;
    for (uint32_t y = film.window.y; y < film.window.end_y(); y++) {
        file.read_row(part, y, pixels);
        for (uint32_t plane = 0; plane < planes; plane++) {
            const size_t first = (size_t(plane) * film.contents.height + y) * width + film.window.x;
            std::copy_n(pixels.begin() + ptrdiff_t(plane * film.window.width), film.window.width,
                        sums.begin() + ptrdiff_t(first));
        }
    }
    return sums;
}

/// The parts of a file in the order of their samples, if each begins where the one before it ends.
std::vector<size_t> order_of(const FilmReader& file) {
    std::vector<size_t> order(file.parts().size());
    for (size_t i = 0; i < order.size(); i++) order[i] = i;
    std::ranges::sort(order, {}, [&](size_t i) { return file.parts()[i].first; });
    for (size_t i = 1; i < order.size(); i++) {
        const FilmRange &before = file.parts()[order[i - 1]], &range = file.parts()[order[i]];
        if (!before.node() || before.end() != range.first || before.window != range.window)
            throw InputError("{}: has {} and {}, with a gap that no render goes on from; render "
                             "what is missing by itself and join it with onde merge",
                             file.path().string(), words_of(before), words_of(range));
    }
    return order;
}

} // namespace

void write_film(const std::filesystem::path& path, const KeptFilm& film) {
    if (!follows_pixels(film.header.identity.integrator))
        throw InputError("{}: a film file is of samples of single pixels, by --integrator path or "
                         "whitted; {} has none",
                         path.string(), word_of(film.header.identity.integrator));
    const Pieces pieces = pieces_of(film);
    if (pieces.ranges.empty()) throw InputError("{}: the film has no samples", path.string());
    FilmWriter file(path, film.header, pieces.ranges, most_ids(film.contents.ids));
    for (size_t part = 0; part < pieces.ranges.size(); part++)
        for_each_row(film, *pieces.sums[part],
                     [&](uint32_t y, const FilmRow& pixels) { file.write_row(part, y, pixels); });
    write_ids(film, file);
    file.finish();
}

KeptFilm read_film(const std::filesystem::path& path, const FilmHeader& wanted) {
    FilmReader file(path);
    check_same(file.header(), wanted, path.string());
    const std::vector<size_t> order = order_of(file);
    KeptFilm film{file.header(), file.parts()[order.front()].window, {}};
    FilmContents& contents = film.contents;
    contents.width = wanted.identity.width;
    contents.height = wanted.identity.height;
    contents.planes = wanted.identity.planes();
    contents.extent.begin = file.parts()[order.front()].first;
    for (const size_t part : order) {
        const FilmRange& range = file.parts()[part];
        file.check_part(part);
        FilmSums sums = read_sums(file, part, film);
        if (const auto node = range.node())
            add_part(contents.parts, {*node, std::move(sums)});
        else
            contents.block = std::move(sums);
        contents.extent.end = uint32_t(range.end());
        contents.extent.pass = range.pass;
        contents.extent.pixels = range.pass_pixels;
    }
    read_ids(file, film);
    if (contents.block.empty())
        contents.block.resize(size_t(contents.planes.count()) * contents.height * contents.width);
    return film;
}

} // namespace onde
