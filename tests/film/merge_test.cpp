// Parts of a film, cut in any way and joined in any order and in any number of steps, are the film.
#include "film/ledger.h"
#include "film/made_film.h"

#include <algorithm>

namespace onde::test {
namespace {

struct Cut {
    uint32_t begin, end;
    Rectangle window;
};

/// Cuts of all samples of all pixels, by chance.
std::vector<Cut> random_cuts(std::mt19937& generator) {
    std::vector<Cut> cuts{{0, 676, WHOLE}};
    for (int i = 0; i < 12; i++) {
        const size_t which = generator() % cuts.size();
        Cut &cut = cuts[which], other = cut;
        const uint32_t blocks = (cut.end - cut.begin + FILM_BLOCK - 1) / FILM_BLOCK;
        if (generator() % 2 == 0 && blocks > 1) {
            cut.end = other.begin =
                cut.begin + FILM_BLOCK * (1 + uint32_t(generator() % (blocks - 1)));
        } else if (generator() % 2 == 0 && cut.window.width > 1) {
            cut.window.width = 1 + uint32_t(generator() % (cut.window.width - 1));
            other.window.x += cut.window.width;
            other.window.width -= cut.window.width;
        } else if (cut.window.height > 1) {
            cut.window.height = 1 + uint32_t(generator() % (cut.window.height - 1));
            other.window.y += cut.window.height;
            other.window.height -= cut.window.height;
        } else {
            continue;
        }
        cuts.push_back(other);
    }
    return cuts;
}

/// Joins two files after the other, by chance, until one is left.
fs::path join_by_pairs(const FilmFolder& folder, std::vector<fs::path> files,
                       std::mt19937& generator) {
    for (size_t step = 0; files.size() > 1; step++) {
        std::ranges::shuffle(files, generator);
        const size_t count = std::min<size_t>(files.size(), 2 + generator() % 3);
        const fs::path joined = folder / ("joined" + std::to_string(step) + ".exr");
        FilmMerge({files.end() - ptrdiff_t(count), files.end()}).write(joined);
        files.resize(files.size() - count);
        files.push_back(joined);
    }
    return files.front();
}

} // namespace

TEST_CASE("parts that are cut in any way join in any order to the bytes of the whole film") {
    const FilmFolder folder;
    write_film(folder / "whole.exr", made_film(0, 676));
    const std::string whole = bytes_of(folder / "whole.exr");
    const Image picture = FilmMerge({folder / "whole.exr"}).picture();
    std::mt19937 generator(3);
    for (int trial = 0; trial < 25; trial++) {
        std::vector<fs::path> files;
        for (const Cut& cut : random_cuts(generator)) {
            files.push_back(folder / fmt::format("part{}.exr", files.size()));
            write_film(files.back(), made_film(cut.begin, cut.end, cut.window));
        }
        std::ranges::shuffle(files, generator);
        FilmMerge merge(files);
        CHECK(merge.missing().empty());
        CHECK(merge.picture().pixels == picture.pixels);
        merge.write(folder / "joined.exr");
        CHECK(bytes_of(folder / "joined.exr") == whole);
        CHECK(bytes_of(join_by_pairs(folder, files, generator)) == whole);
    }
}

TEST_CASE("a merge names what is missing") {
    const FilmFolder folder;
    write_film(folder / "a.exr", made_film(0, 64));
    write_film(folder / "b.exr", made_film(128, 256, {0, 0, 5, HEIGHT}));
    const std::vector<FilmRange> missing =
        FilmMerge({folder / "a.exr", folder / "b.exr"}).missing();
    REQUIRE(missing.size() == 3);
    CHECK(words_of(missing[0]) == "samples 64 to 127 of 13x9 pixels from 0,0");
    CHECK(words_of(missing[1]) == "samples 128 to 255 of 8x9 pixels from 5,0");
    CHECK(words_of(missing[2]) == "samples 256 to 675 of 13x9 pixels from 0,0");
}

TEST_CASE("parts with a sample in common are refused, and so are others' parts") {
    const FilmFolder folder;
    write_film(folder / "a.exr", made_film(0, 128, {0, 0, 5, 5}));
    write_film(folder / "b.exr", made_film(64, 128, {4, 4, 2, 2}));
    CHECK_THROWS_WITH(FilmMerge({folder / "a.exr", folder / "b.exr"}),
                      Catch::Contains("b.exr: has samples 64 to 127 of 2x2 pixels from 4,4, of "
                                      "which") &&
                          Catch::Contains("a.exr has some too"));
    CHECK_THROWS_WITH(FilmMerge({folder / "a.exr", folder / "a.exr"}), Catch::Contains("some too"));
    KeptFilm foreign = made_film(128, 192);
    foreign.header.identity.seed = 8;
    write_film(folder / "c.exr", foreign);
    CHECK_THROWS_WITH(FilmMerge({folder / "a.exr", folder / "c.exr"}),
                      Catch::Contains("c.exr: this film is of another seed"));
}

TEST_CASE("the ledger joins whole nodes by the pixels that have both halves") {
    const std::vector<FilmRange> ranges{range_of({0, 0}, {0, 0, 8, 8}),
                                        range_of({0, 1}, {4, 0, 8, 8}),
                                        range_of({1, 1}, {0, 0, 6, 8})};
    const std::vector<FilmRange> joined = join_ranges(ranges);
    const std::vector<FilmRange> expected{
        range_of({0, 0}, {0, 0, 4, 8}), range_of({1, 0}, {6, 0, 2, 8}),
        range_of({2, 0}, {4, 0, 2, 8}), range_of({0, 1}, {8, 0, 4, 8}),
        range_of({1, 1}, {0, 0, 4, 8})};
    CHECK(joined == expected);
    CHECK(find_overlap(joined) == std::nullopt);
}

} // namespace onde::test
