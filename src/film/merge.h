// Joins film files of one picture, in any order, to the bytes of one render: row by row, so that
// neither their number nor the size of the picture costs memory.
#pragma once

#include "film/film_file.h"
#include "image/image.h"

#include <filesystem>
#include <functional>
#include <list>
#include <vector>

namespace onde {

class FilmMerge {
  public:
    /// Throws InputError, in one sentence, for a file that is damaged, of another picture, or that
    /// has samples which another one has too. Reads all of them once.
    explicit FilmMerge(std::vector<std::filesystem::path> files);

    const FilmHeader& header() const { return header_; }
    /// What there is when all are joined.
    const std::vector<FilmRange>& joined() const { return joined_; }
    /// What the picture lacks.
    std::vector<FilmRange> missing() const;
    /// Per pixel, on average.
    double samples();

    /// Calls it now and then in what follows; what it throws ends that, with nothing written.
    void on_progress(std::function<void()> call) { on_progress_ = std::move(call); }

    /// Writes the film of all. Throws InputError where one of them was interrupted within a pass.
    void write(const std::filesystem::path& path);
    /// The picture of all, as Session::picture() has it; pixels without a sample are black.
    Image picture();
    /// What the samples of all have seen, where they are counted.
    IdCounts ids();
    /// Some of its channels, which the film has.
    std::vector<Image> develop(const std::vector<FilmChannel>& channels);

  private:
    struct Source {
        size_t file, part;
        FilmRange range;
    };
    using Sources = std::vector<const Source*>;

    void add_file(size_t file);
    /// Those of row y, from x = window.x on.
    std::vector<PixelIds> ids_of(uint32_t y, const Rectangle& window);
    void write_ids(FilmWriter& file, const Rectangle& window);
    FilmReader& open(size_t file);
    /// Those that have samples of a node of the tree, of pixels in the band.
    Sources sources_of(const FilmRange& range, const Rectangle& band) const;
    /// Sums over the pixels of a band, plane after plane.
    FilmSums sum(FilmNode node, const Sources& sources, const Rectangle& band);
    void paint(const Source& source, const Rectangle& band, FilmSums& sums);
    uint32_t band_rows(uint32_t width) const;

    std::function<void()> on_progress_;
    std::vector<std::filesystem::path> files_;
    FilmHeader header_;
    size_t first_name_ = 0; ///< file of the header
    std::vector<Source> sources_;
    std::vector<Rectangle> id_windows_; ///< by file, where ids are counted
    std::vector<FilmRange> joined_;
    std::list<std::pair<size_t, FilmReader>> open_; ///< the last ones that were used
};

} // namespace onde
