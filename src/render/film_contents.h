// What a film holds, as values on the host: which samples of which pixels, and their sums.
#pragma once

#include "image/image.h"
#include "render/film_nodes.h"

#include "shared/aovs.h"

#include <CL/cl_platform.h>

#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

namespace onde {

/// The samples of a film: begin to end - 1 of every pixel, and of a pass that was interrupted the
/// samples end to end + pass - 1 of the first `pixels` of its pixels. `begin` is the first of a
/// block, but in films of splats.
struct FilmExtent {
    uint32_t begin = 0, end = 0;
    uint32_t pass = 0, pixels = 0; ///< pass is 0 between passes

    bool operator==(const FilmExtent&) const = default;
};

/// How sums become a picture.
enum class Develop {
    mean,     ///< divided by the fourth component, the number of samples
    light,    ///< the mean, but not below 0
    share,    ///< the mean, but within 0 and 1
    sum,      ///< as they are
    variance, ///< of the mean of radiance, from the sum of its squares
    error,    ///< the standard error of radiance, from the sum of halves (render/noise.h)
};

/// The float4 sums that radiance has; the AOVs of shared/aovs.h have others.
inline constexpr uint32_t RADIANCE_SUMS = AOV_COUNT;

/// A quantity that a film has of every pixel: some components of float4 sums.
struct FilmChannel {
    std::string_view name;    ///< for people and files
    std::string_view letters; ///< one for each component
    uint32_t sums;            ///< number of the AOV, or RADIANCE_SUMS
    uint32_t first;           ///< of the sums' components
    Develop develop;

    constexpr uint32_t components() const { return uint32_t(letters.size()); }
};

inline constexpr FilmChannel RADIANCE{"radiance", "RGB", RADIANCE_SUMS, 0, Develop::light};
inline constexpr FilmChannel SAMPLE_COUNT{"sample-count", "X", RADIANCE_SUMS, 3, Develop::sum};

/// Every channel that there is. A film has those of radiance, and the AOVs that it is asked for.
constexpr Develop develop_of_aov(uint32_t aov) {
    if (aov == AOV_SQUARES) return Develop::variance;
    if (aov == AOV_HALVES) return Develop::error;
    return aov == AOV_ALPHA ? Develop::share : Develop::mean;
}
#define ONDE_CHANNEL(NAME, name, word, letters, SOURCE)                                            \
    {word, letters, AOV_##NAME, 0, develop_of_aov(AOV_##NAME)},
inline constexpr FilmChannel FILM_CHANNELS[] = {RADIANCE, SAMPLE_COUNT, AOVS(ONDE_CHANNEL)};
#undef ONDE_CHANNEL

/// That of the name, or null.
const FilmChannel* find_channel(std::string_view name);

/// Planes of a film with the AOVs of these bits, and the place of one among them.
constexpr uint32_t film_planes(uint32_t aovs) {
    return 1 + uint32_t(std::popcount(aovs));
}
constexpr uint32_t film_plane(uint32_t aovs, uint32_t sums) {
    return sums == RADIANCE_SUMS ? 0 : 1 + uint32_t(std::popcount(aovs & ((1u << sums) - 1)));
}

/// Sums of every pixel, by (plane * height + y) * width + x: of radiance, then of each AOV.
using FilmSums = std::vector<cl_float4>;

/// The picture of a channel from sums of a film with these AOVs; pixels without a sample are black.
Image develop_sums(const FilmSums& sums, uint32_t width, uint32_t height, uint32_t aovs,
                   const FilmChannel& channel);

/// Adds them to `sums`, one by one.
void add_sums(FilmSums& sums, const FilmSums& more);

/// The sums of a whole node.
struct FilmPart {
    FilmNode node;
    FilmSums sums;
};

/// Adds a whole node behind the others, and joins it with those that it completes.
void add_part(std::vector<FilmPart>& parts, FilmPart part);

/// Enough to go on with a film on any device. Films of the same samples have equal contents.
struct FilmContents {
    uint32_t width = 0, height = 0;
    uint32_t aovs = 0; ///< bits of their numbers
    FilmExtent extent;
    std::vector<FilmPart> parts;  ///< cover() of its whole blocks
    FilmSums block;               ///< of the samples behind them; zeros where there are none
    std::vector<uint32_t> splats; ///< of light tracing, SPLAT_WORDS a pixel; else empty. Then there
                                  ///< are no parts, and the block is what they add up to
};

} // namespace onde
