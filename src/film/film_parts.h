// What film files are made of, for their reader and their writer.
#pragma once

#include "core/hash.h"
#include "image/exr_rows.h"

namespace onde {

/// Raised when a file of before could be misunderstood.
inline constexpr int32_t FILM_VERSION = 1;

// Attributes of parts. That of the format is in the first part alone, as the header's texts are.
inline constexpr const char* FILM_FORMAT = "onde:film_format";
inline constexpr const char* FILM_FIRST = "onde:first_sample";
inline constexpr const char* FILM_COUNT = "onde:sample_count";
inline constexpr const char* FILM_PASS = "onde:pass";
inline constexpr const char* FILM_PASS_PIXELS = "onde:pass_pixels";
inline constexpr const char* FILM_CHECKSUM = "onde:checksum";

/// The checksum is of what the header of a part says, and of its rows behind that.
inline Hasher hash_of_header(const ExrPart& part) {
    Hasher hasher;
    hasher.text(part.name);
    hasher.value(part.window.x).value(part.window.y);
    hasher.value(part.window.width).value(part.window.height);
    for (const ExrChannel& channel : part.channels) hasher.text(channel.name);
    for (const auto& [key, number] : part.numbers)
        if (key.starts_with("onde:")) hasher.text(key).value(number);
    for (const auto& [key, text] : part.texts)
        if (key.starts_with("onde:") && key != FILM_CHECKSUM) hasher.text(key).text(text);
    return hasher;
}

} // namespace onde
