// Films whose sums are made up, in files, whole or in parts.
#pragma once

#include "core/error.h"
#include "film/film_file.h"
#include "film/merge.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

namespace onde::test {

namespace fs = std::filesystem;

inline constexpr uint32_t WIDTH = 13, HEIGHT = 9;

inline FilmHeader made_header(uint32_t samples) {
    FilmHeader header{};
    header.identity = {"0123456789abcdef",
                       0,
                       WIDTH,
                       HEIGHT,
                       12,
                       1,
                       7,
                       Filter::box,
                       IntegratorKind::path,
                       Background::environment,
                       1u << AOV_ALBEDO | 1u << AOV_DEPTH,
                       {"other", "key"},
                       NO_IDS,
                       0.0f,
                       0.0f,
                       0.0f,
                       false,
                       LightSampler::automatic};
    header.maker = {"0.1.0", "fedcba9876543210", "a platform, CPU, driver 1"};
    header.device = "a device";
    header.samples = samples;
    header.display = {0.5f, ToneMap::agx};
    return header;
}

/// Sums of up to 64 samples of a block, of the pixels in a window.
inline FilmSums made_sums(uint32_t block, uint32_t samples, const Rectangle& window) {
    FilmSums sums(size_t(made_header(0).identity.planes().count()) * WIDTH * HEIGHT);
    for (size_t i = 0; i < sums.size(); i++) {
        const auto pixel = uint32_t(i % (WIDTH * HEIGHT)), x = pixel % WIDTH, y = pixel / WIDTH;
        std::mt19937 generator(uint32_t(i) * 7919 + block);
        const bool inside =
            x >= window.x && x < window.end_x() && y >= window.y && y < window.end_y();
        const bool is_depth = i / (WIDTH * HEIGHT) == 2; // of which a file has one component
        for (size_t k = 0; k < 3; k++) {
            const float value = float(generator()) * 1e-9f;
            if (inside && samples > 0 && (k == 0 || !is_depth)) sums[i].s[k] = value;
        }
        if (inside) sums[i].s[3] = float(samples);
    }
    return sums;
}

inline constexpr Rectangle WHOLE{0, 0, WIDTH, HEIGHT};

/// Samples begin to end - 1 of a picture of `samples`; `begin` is the first of a block.
inline KeptFilm made_film(uint32_t begin, uint32_t end, const Rectangle& window = WHOLE,
                          uint32_t samples = 676) {
    KeptFilm film{made_header(samples), window, {}};
    FilmContents& contents = film.contents;
    contents.width = WIDTH;
    contents.height = HEIGHT;
    contents.planes = film.header.identity.planes();
    contents.extent = {begin, end, 0, 0};
    for (uint32_t block = begin / FILM_BLOCK; block < end / FILM_BLOCK; block++)
        add_part(contents.parts, {{0, block}, made_sums(block, FILM_BLOCK, window)});
    contents.block = made_sums(end / FILM_BLOCK, end % FILM_BLOCK, window);
    return film;
}

/// A folder of its own, removed with everything in it.
class FilmFolder {
  public:
    FilmFolder() {
        std::string name = (fs::temp_directory_path() / "onde-film-test-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()));
        path_ = name;
    }
    ~FilmFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    FilmFolder(const FilmFolder&) = delete;
    FilmFolder& operator=(const FilmFolder&) = delete;

    fs::path operator/(const std::string& name) const { return path_ / name; }

  private:
    fs::path path_;
};

inline std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

inline void write_bytes(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

} // namespace onde::test
