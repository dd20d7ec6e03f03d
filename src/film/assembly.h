// A film that is put together from units of its samples: blocks of 64 of rectangles of its pixels,
// in whatever order they are done.
#pragma once

#include "core/rectangle.h"
#include "render/film_contents.h"

#include <map>

namespace onde {

class FilmAssembly {
  public:
    /// Goes on from these contents, of whole blocks, which have samples of the window alone.
    FilmAssembly(FilmContents begun, const Rectangle& window);

    /// A film of one block, or its beginning where it is the picture's last, of some of the
    /// window's pixels that have none of it yet.
    void add(const Rectangle& part, const FilmContents& unit);

    /// What is there of all pixels, up to the first block that some lack.
    const FilmContents& contents() const { return contents_; }

  private:
    struct Block {
        FilmSums sums;
        uint64_t missing = 0; ///< pixels
        uint32_t samples = 0;
        IdCounts ids{};
    };
    void append(Block block);

    FilmContents contents_;
    Rectangle window_;
    std::map<uint32_t, Block> blocks_; ///< that wait for pixels or for a block before them
};

} // namespace onde
