// A picture as its file stores it, before it becomes floats or texture bytes; and the list of the
// formats that are read. Nothing outside src/image includes this.
#pragma once

#include "image/image.h"
#include "image/image_io.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace onde {

using FileBytes = std::span<const uint8_t>;

/// What the first bytes of a file tell, before anything is allocated for its pixels.
struct ImageHeader {
    uint32_t width = 0, height = 0, channels = 0;
    uint64_t least_bytes = 0;  ///< of a whole file of that size, as its coding is
    uint32_t sample_bytes = 1; ///< of a decoded sample

    uint64_t pixels() const { return uint64_t(width) * height; }
    uint64_t samples() const { return pixels() * channels; }
};

/// Deflate packs at most 1032 to 1.
inline constexpr uint64_t MOST_DEFLATED = 1032;

/// The least bytes in a coding without a bound: a small picture may take none, a large one that
/// claims more than 16384 samples a byte was made to exhaust memory.
inline uint64_t least_bytes_of_any(uint64_t samples) {
    constexpr uint64_t SMALL = uint64_t(1) << 26, MOST_PER_BYTE = 1 << 14;
    return samples <= SMALL ? 0 : samples / MOST_PER_BYTE;
}

/// Interleaved samples: integers in 0..255 or 0..65535, encoded as sRGB, or linear floats.
using Samples = std::variant<std::vector<uint8_t>, std::vector<uint16_t>, std::vector<float>>;

/// Rows from the top; channels are grey, grey and alpha, RGB or RGBA.
struct StoredImage {
    uint32_t width = 0, height = 0, channels = 0;
    Samples samples;
};

/// Samples for a picture, with room in which bytes become RGBA without a copy.
template <class T>
std::vector<T> samples_of(uint64_t pixels, uint32_t channels) {
    std::vector<T> samples;
    if constexpr (sizeof(T) == 1) samples.reserve(4 * pixels);
    samples.resize(pixels * channels);
    return samples;
}

/// Turns pixels of `channels` bytes into RGBA where they stand. `order` says which byte each of R,
/// G, B and A is; -1 is 0, or opaque. There is room from samples_of().
inline void spread_to_rgba(std::vector<uint8_t>& samples, uint32_t channels,
                           const std::array<int, 4>& order) {
    const size_t pixels = samples.size() / channels;
    samples.resize(4 * pixels);
    for (size_t pixel = pixels; pixel-- > 0;) { // from the last on, as they grow
        std::array<uint8_t, 4> rgba{0, 0, 0, 255};
        for (size_t c = 0; c < 4; ++c)
            if (order[c] >= 0) rgba[c] = samples[pixel * channels + size_t(order[c])];
        std::copy_n(rgba.begin(), 4, samples.begin() + ptrdiff_t(4 * pixel));
    }
}

/// Why a decoder gives up, as the end of a sentence. All of a format's functions throw it.
class ImageProblem : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline std::string_view as_text(FileBytes file) {
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

/// A format that is read. `decode` is called only after `header` was found acceptable.
struct ImageFormat {
    const char* name;
    bool (*recognise)(FileBytes file);
    ImageHeader (*header)(FileBytes file);
    StoredImage (*decode)(FileBytes file);
    ImageMetadata (*metadata)(FileBytes file); ///< null: it has none that we read
};

extern const ImageFormat PNG_FORMAT, EXR_FORMAT, JPEG_FORMAT, WEBP_FORMAT, TIFF_FORMAT, BMP_FORMAT,
    HDR_FORMAT, PFM_FORMAT, KTX2_FORMAT, TGA_FORMAT;

/// Those channels of an OpenEXR file whose header has been found acceptable.
StoredImage decode_exr(FileBytes file, const std::vector<std::string>& names);

/// A PNG file of interleaved bytes, 1, 3 or 4 channels, in sRGB.
std::string encode_png(std::span<const uint8_t> bytes, uint32_t width, uint32_t height,
                       uint32_t channels, const ImageMetadata& metadata);

} // namespace onde
