// What a film holds, as values on the host: which samples of which pixels, and their sums.
#pragma once

#include <CL/cl_platform.h>

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
    mean, ///< divided by the fourth component, the number of samples
    sum,  ///< as they are
};

/// A quantity that a film has of every pixel: some components of the float4 sums of a plane.
struct FilmChannel {
    std::string_view name; ///< for people and files
    uint32_t plane;        ///< of the film
    uint32_t first, components;
    Develop develop;
};

inline constexpr FilmChannel RADIANCE{"radiance", 0, 0, 3, Develop::mean};
inline constexpr FilmChannel SAMPLE_COUNT{"sample-count", 0, 3, 1, Develop::sum};

/// Every channel that there is. A film has the planes of those that it is asked for.
inline constexpr FilmChannel FILM_CHANNELS[] = {RADIANCE, SAMPLE_COUNT};

/// Sums of every pixel, by y * width + x.
using FilmSums = std::vector<cl_float4>;

/// Enough to go on with a film on any device.
struct FilmContents {
    struct Plane {
        FilmSums block;                ///< of the block that samples are added to
        std::vector<FilmSums> pending; ///< by level; empty where nothing is pending
    };

    uint32_t width = 0, height = 0;
    FilmExtent extent;
    std::vector<Plane> planes;
    std::vector<uint32_t> splats; ///< of light tracing, SPLAT_WORDS a pixel; else empty
};

} // namespace onde
