// What a film holds, as values on the host: which samples of which pixels, and their sums.
#pragma once

#include "shared/aovs.h"

#include <CL/cl_platform.h>

#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

namespace onde {

/// Samples of a pixel that are added one by one, in their order; see render/film.h.
inline constexpr uint32_t FILM_BLOCK = 64;

/// The samples of a film: begin to end - 1 of every pixel, and of a pass that was interrupted the
/// samples end to end + pass - 1 of the first `pixels` pixels of pixel_order().
struct FilmExtent {
    uint32_t begin = 0, end = 0;
    uint32_t pass = 0, pixels = 0; ///< pass is 0 between passes

    /// The block that samples are added to: its first sample is FILM_BLOCK times that.
    uint32_t block() const { return (pass == 0 && end > begin ? end - 1 : end) / FILM_BLOCK; }
    /// Whether that level of the pending sums holds something: its bit is set, and the block before
    /// the one that set it is the film's.
    bool is_pending(size_t level) const {
        const uint32_t set_at = block() >> level << level;
        return (block() >> level & 1) != 0 && set_at > begin / FILM_BLOCK;
    }

    bool operator==(const FilmExtent&) const = default;
};

/// How sums become a picture.
enum class Develop {
    mean,  ///< divided by the fourth component, the number of samples
    light, ///< the mean, but not below 0
    share, ///< the mean, but within 0 and 1
    sum,   ///< as they are
};

/// The float4 sums that radiance has; the AOVs of shared/aovs.h have others.
inline constexpr uint32_t RADIANCE_SUMS = AOV_COUNT;

/// A quantity that a film has of every pixel: some components of float4 sums.
struct FilmChannel {
    std::string_view name; ///< for people and files
    uint32_t sums;         ///< number of the AOV, or RADIANCE_SUMS
    uint32_t first, components;
    Develop develop;
};

inline constexpr FilmChannel RADIANCE{"radiance", RADIANCE_SUMS, 0, 3, Develop::light};
inline constexpr FilmChannel SAMPLE_COUNT{"sample-count", RADIANCE_SUMS, 3, 1, Develop::sum};

/// Every channel that there is. A film has those of radiance, and the AOVs that it is asked for.
constexpr Develop develop_of_aov(uint32_t aov) {
    return aov == AOV_ALPHA ? Develop::share : Develop::mean;
}
#define ONDE_CHANNEL(NAME, name, components)                                                       \
    {#name, AOV_##NAME, 0, components, develop_of_aov(AOV_##NAME)},
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

/// Enough to go on with a film on any device.
struct FilmContents {
    uint32_t width = 0, height = 0;
    uint32_t aovs = 0; ///< bits of their numbers
    FilmExtent extent;
    FilmSums block;                ///< of the block that samples are added to
    std::vector<FilmSums> pending; ///< by level; empty where nothing is pending
    std::vector<uint32_t> splats;  ///< of light tracing, SPLAT_WORDS a pixel; else empty
};

} // namespace onde
