// Units of a film, done in whatever order, are put together to the film.
#include "film/assembly.h"
#include "film/made_film.h"
#include "film/region.h"

#include <algorithm>
#include <cstring>

namespace onde::test {
namespace {

struct Unit {
    uint32_t begin, end;
    Rectangle part;
};

/// Of samples `from` to 675 of a window.
std::vector<Unit> units_of(const Rectangle& window, uint32_t from, uint32_t bands) {
    std::vector<Unit> units;
    for (uint32_t begin = from; begin < 676; begin += FILM_BLOCK)
        for (uint32_t band = 0; band < bands; band++)
            units.push_back(
                {begin, std::min(begin + FILM_BLOCK, 676u), tile_of(window, 1, bands, band)});
    return units;
}

void check_same_film(const FilmContents& a, const FilmContents& b) {
    const auto same_sums = [](const FilmSums& x, const FilmSums& y) {
        return x.size() == y.size() &&
               std::memcmp(x.data(), y.data(), x.size() * sizeof(cl_float4)) == 0;
    };
    CHECK(a.extent == b.extent);
    REQUIRE(a.parts.size() == b.parts.size());
    for (size_t i = 0; i < a.parts.size(); i++) {
        CHECK(a.parts[i].node == b.parts[i].node);
        CHECK(same_sums(a.parts[i].sums, b.parts[i].sums));
    }
    CHECK(same_sums(a.block, b.block));
}

} // namespace

TEST_CASE("units in any order make the film, from wherever it was begun") {
    const Rectangle inner{2, 1, 9, 7};
    std::mt19937 generator(5);
    for (const Rectangle& window : {WHOLE, inner})
        for (const uint32_t from : {0u, 192u})
            for (const uint32_t bands : {1u, 3u}) {
                FilmContents begun = made_film(0, from, window).contents;
                FilmAssembly assembly(std::move(begun), window);
                std::vector<Unit> units = units_of(window, from, bands);
                std::ranges::shuffle(units, generator);
                for (const Unit& unit : units)
                    assembly.add(unit.part, made_film(unit.begin, unit.end, unit.part).contents);
                check_same_film(assembly.contents(), made_film(0, 676, window).contents);
            }
}

TEST_CASE("what is there of a film ends at the first block that some pixels lack") {
    FilmAssembly assembly(made_film(0, 0).contents, WHOLE);
    const Rectangle above = tile_of(WHOLE, 1, 2, 0), below = tile_of(WHOLE, 1, 2, 1);
    const auto add = [&](uint32_t begin, const Rectangle& part) {
        assembly.add(part, made_film(begin, begin + FILM_BLOCK, part).contents);
        return assembly.contents().extent.end;
    };
    CHECK(add(64, above) == 0);
    CHECK(add(64, below) == 0);
    CHECK(add(0, below) == 0);
    CHECK(add(0, above) == 128);
    CHECK(add(128, above) == 128);
    check_same_film(assembly.contents(), made_film(0, 128).contents);
}

} // namespace onde::test
