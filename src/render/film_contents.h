// What a film holds, as values on the host: which samples of which pixels, and their sums.
#pragma once

#include "image/image.h"
#include "render/film_nodes.h"
#include "render/id_counts.h"

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

/// The float4 sums that radiance has; the AOVs of shared/aovs.h have others. Behind it come those
/// of groups of lights.
inline constexpr uint32_t RADIANCE_SUMS = AOV_COUNT;
inline constexpr uint32_t GROUP_SUMS = RADIANCE_SUMS + 1;

/// A quantity that a film has of every pixel: some components of float4 sums.
struct FilmChannel {
    std::string_view name;    ///< for people and files
    std::string_view letters; ///< one for each component
    uint32_t sums;            ///< number of the AOV, RADIANCE_SUMS, or GROUP_SUMS and a group's
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

/// The light of a group, which outlives what is returned; `number` is its place among the film's.
constexpr FilmChannel group_channel(std::string_view name, size_t number) {
    return {name, "RGB", GROUP_SUMS + uint32_t(number), 0, Develop::mean};
}

/// What a film has of each pixel: float4 sums of radiance, of each AOV, of each group of lights.
struct FilmPlanes {
    uint32_t aovs = 0; ///< bits of their numbers
    uint32_t groups = 0;

    constexpr uint32_t first_group() const { return 1 + uint32_t(std::popcount(aovs)); }
    constexpr uint32_t count() const { return first_group() + groups; }
    constexpr bool has(uint32_t sums) const {
        if (sums >= GROUP_SUMS) return sums - GROUP_SUMS < groups;
        return sums == RADIANCE_SUMS || (aovs >> sums & 1) != 0;
    }
    /// The place of those sums, which it has.
    constexpr uint32_t plane(uint32_t sums) const {
        if (sums >= GROUP_SUMS) return first_group() + sums - GROUP_SUMS;
        return sums == RADIANCE_SUMS ? 0 : 1 + uint32_t(std::popcount(aovs & ((1u << sums) - 1)));
    }
    bool operator==(const FilmPlanes&) const = default;
};

/// Sums of every pixel, by (plane * height + y) * width + x.
using FilmSums = std::vector<cl_float4>;

/// The picture of a channel from sums of a film with these planes; pixels without a sample are
/// black.
Image develop_sums(const FilmSums& sums, uint32_t width, uint32_t height, const FilmPlanes& planes,
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
    FilmPlanes planes;
    FilmExtent extent;
    std::vector<FilmPart> parts;  ///< cover() of its whole blocks
    FilmSums block;               ///< of the samples behind them; zeros where there are none
    IdCounts ids;                 ///< where they are counted; of the samples of the whole extent
    std::vector<uint32_t> splats; ///< of light tracing, SPLAT_WORDS a pixel; else empty. Then there
                                  ///< are no parts, and the block is what they add up to
};

} // namespace onde
