// Cryptomatte 1.1 (Friedman and Jones, "Cryptomatte specification"): mattes of named things, as
// pairs of a name's hash and the share of the pixel that shows the thing, the largest share first.
#pragma once

#include "image/image_io.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace onde {

/// MurmurHash3_x86_32 of a text, from 0.
uint32_t murmur_hash(std::string_view text);

/// The hash as the bits of a float that is neither denormal, infinite nor NaN.
uint32_t cryptomatte_id(std::string_view name);

/// So many samples of a pixel show the thing of that name.
struct NamedCount {
    uint32_t name = 0; ///< index
    uint32_t count = 0;
};

/// What the pixels of a picture show, row by row: of each the counts, any order, each name once,
/// and of how many samples.
struct NamedCounts {
    uint32_t width = 0, height = 0;
    std::vector<std::string> names{}; ///< each once
    std::vector<std::vector<NamedCount>> pixels{};
    std::vector<uint32_t> samples{};
};

/// At most so many names of a pixel are kept, those with the largest shares.
inline constexpr size_t MOST_RANKS = 16;

/// Layers "NAME00.R", "NAME00.G", ..., as many as the pixels need: R and B are ids, G and A shares.
std::vector<ExrLayer> cryptomatte_layers(const NamedCounts& counts, const std::string& name);

/// The attributes that name the layers' hash and list all names.
ImageMetadata cryptomatte_metadata(const NamedCounts& counts, const std::string& name);

/// The layers for eyes: a colour for each name.
Image cryptomatte_preview(const NamedCounts& counts);

} // namespace onde
