// Film files: OpenEXR of 32 bits with a part for each node of the tree of samples and each
// rectangle of pixels that has it; docs/films.md says what is in them. Read and written row by row.
// A file from outside is checked before anything is allocated for what it claims.
#pragma once

#include "core/hash.h"
#include "film/id_rows.h"
#include "film/identity.h"
#include "film/planes.h"

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace onde {

/// The samples that a part of a file has of a rectangle: a whole node, or the first of a block.
struct FilmRange {
    Rectangle window;
    uint32_t first = 0, count = 0;      ///< samples of every pixel
    uint32_t pass = 0, pass_pixels = 0; ///< as in FilmExtent, of an interrupted render

    uint64_t end() const { return uint64_t(first) + count; }
    /// That of a whole one.
    std::optional<FilmNode> node() const;
    /// The node, or where samples still go to a block, that block.
    FilmNode place() const { return node().value_or(FilmNode{0, first / FILM_BLOCK}); }
    bool operator==(const FilmRange&) const = default;
};

/// A whole node of a window.
FilmRange range_of(const FilmNode& node, const Rectangle& window);

/// Of the ids of a file: what holds the windows of its parts.
Rectangle ids_window(std::span<const FilmRange> parts);

/// "samples 64 to 127 of 320x240 pixels from 0,0"
std::string words_of(const FilmRange& range);

/// The channels of films of that identity.
inline PlaneChannels channels_of(const FilmIdentity& identity) {
    return {identity.aovs, identity.light_groups};
}

/// A sum of every plane's pixel of a row of some pixels, plane after plane.
using FilmRow = std::vector<cl_float4>;

class FilmReader {
  public:
    /// Throws InputError for what is no film file, or one of a format that is not known here.
    explicit FilmReader(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    const FilmHeader& header() const { return header_; }
    const std::vector<FilmRange>& parts() const { return ranges_; }

    /// Throws InputError unless the part is, bit for bit, as it was written.
    void check_part(size_t part);
    /// Row y of the picture, of the window's width.
    void read_row(size_t part, uint32_t y, FilmRow& sums);

    /// The window of the ids; none in films that do not count them.
    std::optional<Rectangle> ids_window() const;
    /// The same as of parts.
    void check_ids();
    void read_ids(uint32_t y, std::vector<PixelIds>& ids);

  private:
    const ExrPart& ids_part() const { return file_.parts().back(); }
    void check_sum(size_t part, size_t words_of_row);

    std::filesystem::path path_;
    ExrRowReader file_;
    FilmHeader header_;
    PlaneChannels channels_;
    std::vector<FilmRange> ranges_;
    std::vector<uint32_t> words_; ///< of a row
};

class FilmWriter {
  public:
    /// Of a film that counts ids: the most of a pixel.
    FilmWriter(const std::filesystem::path& path, const FilmHeader& header,
               std::vector<FilmRange> parts, size_t most_ids = 0);

    /// The rows of the first part from the top, then those of the next, and so on.
    void write_row(size_t part, uint32_t y, std::span<const cl_float4> sums);
    /// Behind all of them, the ids of the rows of ids_window(), from the top.
    void write_ids(uint32_t y, std::span<const PixelIds> ids);
    /// The file takes its place.
    void finish();

  private:
    void write_words(size_t part, uint32_t y);

    PlaneChannels channels_;
    size_t id_slots_;
    std::vector<FilmRange> ranges_;
    std::vector<ExrPart> parts_;
    std::vector<Hasher> hashes_;
    WholeFile out_;
    ExrRowWriter file_;
    std::vector<uint32_t> words_;
};

/// A film that left its session, to go on with in another: samples of a rectangle from one on.
struct KeptFilm {
    FilmHeader header;
    Rectangle window; ///< whose pixels have samples
    FilmContents contents;
};

/// Throws InputError unless the film has samples, each of one pixel.
void write_film(const std::filesystem::path& path, const KeptFilm& film);

/// The film of a file. Throws InputError unless it has, of one rectangle, samples without a gap and
/// is of the same as `wanted`, which bounds its memory.
KeptFilm read_film(const std::filesystem::path& path, const FilmHeader& wanted);

} // namespace onde
