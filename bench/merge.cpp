// How long onde merge takes over many small parts of a film, and how much memory: a picture of
// made-up sums, cut in tiles and blocks of samples. The result is compared with the film in one.
#include "front.h"

#include "film/merge.h"

#include "core/error.h"
#include "core/timer.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace onde::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
    uint32_t parts = 10000, size = 320, tiles = 10;
};

/// A folder of its own, removed with everything in it.
struct Folder {
    fs::path path = fs::temp_directory_path() / fmt::format("onde-bench-merge-{}", getpid());

    Folder() { fs::create_directories(path); }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
};

FilmHeader make_header(const Options& options, uint32_t samples) {
    FilmHeader header{};
    header.identity.scene = "made up";
    header.identity.width = header.identity.height = options.size;
    header.samples = samples;
    return header;
}

/// Block `block` of a window.
KeptFilm make_part(const FilmHeader& header, const Rectangle& window, uint32_t block) {
    KeptFilm film{header, window, {}};
    const uint32_t size = header.identity.width;
    film.contents.width = film.contents.height = size;
    film.contents.extent = {block * FILM_BLOCK, (block + 1) * FILM_BLOCK, 0, 0};
    FilmSums sums(size_t(size) * size);
    for (uint32_t y = window.y; y < window.end_y(); y++)
        for (uint32_t x = window.x; x < window.end_x(); x++) {
            const float value =
                float((x * 7919u + y * 104729u + block * 1299709u) % 10007u) * 0.01f;
            sums[size_t(y) * size + x] = {{value, 2 * value, 3 * value, float(FILM_BLOCK)}};
        }
    film.contents.parts.push_back({{0, block}, std::move(sums)});
    return film;
}

double peak_mebibytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024;
}

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void run(const Options& options) {
    const Folder folder;
    const uint32_t blocks = std::max(1u, options.parts / (options.tiles * options.tiles));
    const FilmHeader header = make_header(options, blocks * FILM_BLOCK);
    std::vector<fs::path> files;
    KeptFilm whole{header, {0, 0, options.size, options.size}, {}};
    for (uint32_t block = 0; block < blocks; block++) {
        for (uint32_t tile = 0; tile < options.tiles * options.tiles; tile++) {
            const uint32_t side = options.size / options.tiles;
            const Rectangle window{tile % options.tiles * side, tile / options.tiles * side, side,
                                   side};
            files.push_back(folder.path / fmt::format("{}-{}.exr", block, tile));
            write_film(files.back(), make_part(header, window, block));
        }
        KeptFilm all = make_part(header, whole.window, block);
        add_part(whole.contents.parts, std::move(all.contents.parts.front()));
    }
    whole.contents.width = whole.contents.height = options.size;
    whole.contents.extent = {0, blocks * FILM_BLOCK, 0, 0};
    write_film(folder.path / "whole", whole);
    whole.contents.parts.clear();

    const double before = peak_mebibytes();
    const Timer timer;
    FilmMerge merge(files);
    const double read = timer.seconds();
    merge.write(folder.path / "merged");
    fmt::print("{} parts of {}x{} pixels, {} blocks of samples: {:.2f} s, of them {:.2f} to check "
               "the parts; peak memory {:.0f} MiB, {:.0f} before\n",
               files.size(), options.size / options.tiles, options.size / options.tiles, blocks,
               timer.seconds(), read, peak_mebibytes(), before);
    if (bytes_of(folder.path / "merged") != bytes_of(folder.path / "whole"))
        throw InputError("the merged film differs from the one of all samples");
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("merge", "Seconds and memory to join many small parts of a film");
    onde::Command root = line.root();
    root.option("--parts", &options.parts, "How many (10000)", {.least = 1, .most = 1000000});
    root.option("--size", &options.size, "Pixels of a side of the picture (320)",
                {.least = 16, .most = 8192});
    root.option("--tiles", &options.tiles, "Of a side (10)", {.least = 1, .most = 100});
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
