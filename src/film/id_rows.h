// The ids of a film (render/id_counts.h) as a part of its file, row by row: as many slots as the
// pixel that shows the most things needs, each of three whole numbers.
#pragma once

#include "core/rectangle.h"
#include "image/exr_rows.h"
#include "render/id_counts.h"

#include <span>
#include <vector>

namespace onde {

inline constexpr const char* IDS_PART = "ids";
inline constexpr size_t MOST_ID_SLOTS = 9999;

/// "id.0000.count", "id.0000.material", "id.0000.object", "id.0001.count", ...
std::vector<ExrChannel> id_channels(size_t slots);
constexpr size_t id_words(size_t slots, size_t width) {
    return 3 * slots * width;
}

/// A row of pixels into words, channel after channel; they have no more ids than slots.
void pack_ids(std::span<const PixelIds> pixels, size_t slots, std::span<uint32_t> words);
/// And back. Throws std::runtime_error, with the end of a sentence, for what is none.
void unpack_ids(std::span<const uint32_t> words, size_t slots, std::span<PixelIds> pixels);

} // namespace onde
