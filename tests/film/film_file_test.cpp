// Films in files: what is written is read, and what is wrong with a file is said in one sentence.
#include "film/film_parts.h"
#include "film/made_film.h"
#include "image/image_io.h"

#include <cstring>

namespace onde::test {
namespace {

bool same_sums(const FilmSums& a, const FilmSums& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

bool same_contents(const FilmContents& a, const FilmContents& b) {
    const auto same_part = [](const FilmPart& x, const FilmPart& y) {
        return x.node == y.node && same_sums(x.sums, y.sums);
    };
    return a.extent == b.extent && same_sums(a.block, b.block) &&
           std::ranges::equal(a.parts, b.parts, same_part);
}

/// Reads all of it; the sentence of what is wrong, or nothing.
std::string problem_of(const fs::path& path) {
    try {
        FilmMerge merge({path});
        merge.picture();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

std::string replaced(std::string bytes, const std::string& from, const std::string& to) {
    const size_t at = bytes.find(from);
    REQUIRE(at != std::string::npos);
    return bytes.replace(at, from.size(), to);
}

/// The value of an attribute lies behind its name, its type and its size.
std::string with_number(std::string bytes, const char* key, int32_t value) {
    const std::string name = std::string(key) + '\0' + "int" + '\0';
    const size_t at = bytes.find(name);
    REQUIRE(at != std::string::npos);
    std::memcpy(&bytes[at + name.size() + 4], &value, sizeof(value));
    return bytes;
}

} // namespace

TEST_CASE("a film is read as it was written, of all pixels or of some") {
    const FilmFolder folder;
    for (const Rectangle& window : {WHOLE, Rectangle{3, 2, 7, 5}, Rectangle{12, 8, 1, 1}})
        for (const auto& [begin, end] :
             {std::pair{0u, 1u}, {0u, 64u}, {64u, 65u}, {64u, 256u}, {192u, 676u}, {0u, 676u}}) {
            INFO("samples " << begin << " to " << end << " from " << window.x);
            const KeptFilm film = made_film(begin, end, window);
            write_film(folder / "a.exr", film);
            const KeptFilm read = read_film(folder / "a.exr", made_header(1000));
            CHECK(read.window == window);
            CHECK(same_contents(read.contents, film.contents));
            CHECK(texts_of(read.header) == texts_of(film.header));
        }
}

TEST_CASE("a film that was interrupted within a pass is read as it was written") {
    const FilmFolder folder;
    for (const uint32_t end : {64u, 70u}) {
        KeptFilm film = made_film(0, end);
        film.contents.extent.pass = 2;
        film.contents.extent.pixels = 11;
        write_film(folder / "a.exr", film);
        CHECK(
            same_contents(read_film(folder / "a.exr", made_header(1000)).contents, film.contents));
        CHECK_THROWS_WITH(FilmMerge({folder / "a.exr"}).write(folder / "b.exr"),
                          Catch::Contains("go on with it by --resume first"));
        CHECK_FALSE(fs::exists(folder / "b.exr"));
    }
}

TEST_CASE("a film of another picture, program or kind of device is refused, with what differs") {
    const FilmFolder folder;
    write_film(folder / "a.exr", made_film(0, 64));
    const auto refused = [&](const FilmHeader& wanted, const std::string& words) {
        CHECK_THROWS_WITH(read_film(folder / "a.exr", wanted), Catch::Contains(words));
    };
    FilmHeader other = made_header(676);
    other.identity.scene = "another";
    refused(other, "another scene");
    other = made_header(676);
    other.identity.aovs = 0;
    refused(other, "another set of AOVs");
    other = made_header(676);
    other.maker.kernels = "0";
    refused(other, "another hash of kernels, fedcba9876543210 instead of 0");
    other = made_header(676);
    other.maker.device_class = "a GPU";
    refused(other, "another class of devices");
}

TEST_CASE("a film with a gap is not gone on from") {
    const FilmFolder folder;
    write_film(folder / "a.exr", made_film(0, 64));
    write_film(folder / "b.exr", made_film(128, 192));
    FilmMerge({folder / "a.exr", folder / "b.exr"}).write(folder / "both.exr");
    CHECK_THROWS_WITH(read_film(folder / "both.exr", made_header(676)), Catch::Contains("a gap"));
}

TEST_CASE("every changed bit and every lost byte of a film is found") {
    const FilmFolder folder;
    write_film(folder / "a.exr", made_film(64, 200, {2, 3, 2, 2}));
    const std::string good = bytes_of(folder / "a.exr");
    REQUIRE(problem_of(folder / "a.exr").empty());
    const Image picture = FilmMerge({folder / "a.exr"}).picture();
    size_t unnoticed = 0;
    for (size_t i = 0; i < good.size(); i++) {
        std::string bad = good;
        bad[i] = char(bad[i] ^ (1 << i % 8));
        write_bytes(folder / "bad.exr", bad);
        const std::string problem = problem_of(folder / "bad.exr");
        INFO("byte " << i << ": " << problem);
        CHECK(problem.find('\n') == std::string::npos);
        if (!problem.empty()) continue;
        unnoticed++; // what no reader of ours looks at, such as the aspect of pixels
        CHECK(FilmMerge({folder / "bad.exr"}).picture().pixels == picture.pixels);
    }
    CHECK(unnoticed < 200 * FilmReader(folder / "a.exr").parts().size());
    for (size_t size = 0; size < good.size(); size += 7) {
        write_bytes(folder / "bad.exr", good.substr(0, size));
        INFO("cut at " << size);
        CHECK(problem_of(folder / "bad.exr") != "");
    }
}

TEST_CASE("what is no film, and a film of another format, are named as such") {
    const FilmFolder folder;
    const Image image(4, 4, 3);
    write_exr(folder / "picture.exr", image, {}, ExrDepth::full_float);
    CHECK_THROWS_WITH(FilmReader(folder / "picture.exr"), Catch::Contains("compressed"));
    write_bytes(folder / "text.exr", "no picture");
    CHECK_THROWS_WITH(FilmReader(folder / "text.exr"), Catch::Contains("no OpenEXR file"));
    CHECK_THROWS_WITH(FilmReader(folder / "none.exr"), Catch::Contains("cannot be read"));
    fs::create_directory(folder / "folder.exr");
    CHECK_THROWS_WITH(FilmReader(folder / "folder.exr"), Catch::Contains("is a folder"));
    write_film(folder / "a.exr", made_film(0, 64));
    const std::string good = bytes_of(folder / "a.exr");
    for (const int32_t format : {0, 2, -1}) {
        write_bytes(folder / "b.exr", with_number(good, FILM_FORMAT, format));
        CHECK_THROWS_WITH(FilmReader(folder / "b.exr"),
                          Catch::Contains(fmt::format("of format {}", format)));
    }
    write_bytes(folder / "b.exr", replaced(good, "onde:film_format", "onde:gilm_format"));
    CHECK_THROWS_WITH(FilmReader(folder / "b.exr"), Catch::Contains("no film file of Onde"));
}

TEST_CASE("a film that claims what it has not is refused before memory is taken") {
    const FilmFolder folder;
    write_film(folder / "a.exr", made_film(0, 64));
    const std::string good = bytes_of(folder / "a.exr");
    const auto check = [&](const std::string& bytes) {
        write_bytes(folder / "b.exr", bytes);
        const std::string problem = problem_of(folder / "b.exr");
        INFO(problem);
        CHECK(problem != "");
    };
    for (const char* window : {"dataWindow", "displayWindow"}) {
        const std::string name = std::string(window) + '\0' + "box2i" + '\0';
        const size_t at = good.find(name);
        REQUIRE(at != std::string::npos);
        for (const int32_t size : {-2, 60000, 65535, INT32_MAX}) {
            std::string bytes = good;
            std::memcpy(&bytes[at + name.size() + 4 + 8], &size, 4);
            std::memcpy(&bytes[at + name.size() + 4 + 12], &size, 4);
            check(bytes);
        }
    }
    for (const int32_t count : {0, -1, 63, 65, 128, 1 << 24, INT32_MAX})
        check(with_number(good, FILM_COUNT, count));
    for (const int32_t first : {-64, 1, 1 << 25}) check(with_number(good, FILM_FIRST, first));
}

} // namespace onde::test
