// Which samples of which pixels there are in parts of films: what they join to, and what is
// missing.
#pragma once

#include "film/film_file.h"

#include <span>
#include <vector>

namespace onde {

/// The fewest parts that hold the samples of these, which have none in common: whole nodes joined
/// as the tree says, by rectangles in the one form that each set of pixels has. In the order of
/// their samples.
std::vector<FilmRange> join_ranges(std::span<const FilmRange> ranges);

/// Those of a picture's samples that these parts lack, in the order of samples; their counts need
/// not be those of nodes. A picture that its noise ends lacks none: nobody knows which.
std::vector<FilmRange> missing_ranges(std::span<const FilmRange> ranges, const FilmHeader& header);

/// Two of these that have a sample of a pixel in common, by their indices.
std::optional<std::pair<size_t, size_t>> find_overlap(std::span<const FilmRange> ranges);

} // namespace onde
