// Ids of films in files.
#include "film/made_film.h"

namespace onde::test {
namespace {

/// A film of two whole blocks whose pixels show from none to four of three things.
KeptFilm film_with_ids(uint32_t begin, uint32_t end, const Rectangle& window = WHOLE) {
    KeptFilm film = made_film(begin, end, window);
    film.header.names = {{"a", "b \"quoted\"", "c"}, {"x", "x", "c"}, {"m", "n"}};
    film.header.identity.ids = hash_of_names(film.header.names);
    film.contents.ids.resize(WIDTH * HEIGHT);
    for (uint32_t y = window.y; y < window.end_y(); y++)
        for (uint32_t x = window.x; x < window.end_x(); x++)
            for (uint32_t i = 0; i < (x + y) % 5; i++)
                add_id(film.contents.ids[y * WIDTH + x],
                       i == 3 ? NOTHING_SEEN : SeenId{i, (x + begin) % 2}, 1 + x);
    return film;
}

} // namespace

TEST_CASE("ids of a film are read as they were written, of all pixels or of some") {
    const FilmFolder folder;
    for (const Rectangle& window : {WHOLE, Rectangle{2, 3, 7, 4}}) {
        const KeptFilm film = film_with_ids(0, 128, window);
        write_film(folder / "a.exr", film);
        const KeptFilm read = read_film(folder / "a.exr", film.header);
        CHECK(read.contents.ids == film.contents.ids);
        CHECK(read.header.names == film.header.names);
    }
}

TEST_CASE("ids of parts are added when they are joined, in any order to the same bytes") {
    const FilmFolder folder;
    const Rectangle left{0, 0, 6, HEIGHT}, right{6, 0, WIDTH - 6, HEIGHT};
    write_film(folder / "a.exr", film_with_ids(0, 64));
    write_film(folder / "b.exr", film_with_ids(64, 128, left));
    write_film(folder / "c.exr", film_with_ids(64, 128, right));
    FilmMerge(std::vector<fs::path>{folder / "a.exr", folder / "b.exr", folder / "c.exr"})
        .write(folder / "abc.exr");
    FilmMerge(std::vector<fs::path>{folder / "c.exr", folder / "a.exr"}).write(folder / "ca.exr");
    FilmMerge(std::vector<fs::path>{folder / "b.exr", folder / "ca.exr"}).write(folder / "bca.exr");
    CHECK(bytes_of(folder / "abc.exr") == bytes_of(folder / "bca.exr"));
    IdCounts expected = film_with_ids(0, 64).contents.ids;
    const IdCounts more = film_with_ids(64, 128).contents.ids;
    for (size_t i = 0; i < expected.size(); i++)
        for (const IdCount& seen : more[i]) add_id(expected[i], seen.id, seen.count);
    CHECK(FilmMerge({folder / "abc.exr"}).ids() == expected);
}

TEST_CASE("every changed bit of ids is found, and so are ids without a name") {
    const FilmFolder folder;
    const KeptFilm film = film_with_ids(0, 64);
    write_film(folder / "a.exr", film);
    const std::string whole = bytes_of(folder / "a.exr");
    const size_t begin =
        whole.size() - size_t(3 * 4 * 4 * WIDTH * HEIGHT); // of the last part's rows
    std::mt19937 generator(3);
    int unnoticed = 0; // of the frames of rows, which no reader needs
    for (int i = 0; i < 60; i++) {
        std::string damaged = whole;
        damaged[begin + generator() % (whole.size() - begin)] ^= char(1 << generator() % 8);
        write_bytes(folder / "b.exr", damaged);
        try {
            const KeptFilm read = read_film(folder / "b.exr", film.header);
            CHECK(read.contents.ids == film.contents.ids);
            unnoticed++;
        } catch (const InputError&) {
            CHECK_THROWS_AS(FilmMerge({folder / "b.exr"}), InputError);
        }
    }
    CHECK(unnoticed <= 3);
    KeptFilm nameless = film;
    nameless.contents.ids[7] = {{{9, 0}, 64}};
    write_film(folder / "c.exr", nameless);
    CHECK_THROWS_WITH(read_film(folder / "c.exr", film.header),
                      Catch::Contains("its ids have no names"));
    KeptFilm renamed = film;
    renamed.header.names.objects[0] = "z";
    write_film(folder / "d.exr", renamed);
    CHECK_THROWS_WITH(FilmReader(folder / "d.exr"), Catch::Contains("names have another hash"));
}

} // namespace onde::test
