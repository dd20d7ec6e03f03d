// What the samples of each pixel have seen first, counted: whole numbers, so that sums are the same
// whatever the order and the split of the samples, however many things a pixel shows.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace onde {

/// A thing and what it is made of, or NOTHING_SEEN.
struct SeenId {
    uint32_t object = 0, material = 0; ///< object: as upload/objects.h counts them

    auto operator<=>(const SeenId&) const = default;
};

inline constexpr SeenId NOTHING_SEEN{0xffffffffu, 0xffffffffu};

struct IdCount {
    SeenId id;
    uint32_t count = 0; ///< samples

    bool operator==(const IdCount&) const = default;
};

/// Ascending by id, each once.
using PixelIds = std::vector<IdCount>;

/// Adds samples of a thing.
void add_id(PixelIds& ids, SeenId id, uint32_t count);

/// By y * width + x; empty in a film that does not count.
using IdCounts = std::vector<PixelIds>;

/// The most ids of a pixel.
size_t most_ids(const IdCounts& counts);

} // namespace onde
