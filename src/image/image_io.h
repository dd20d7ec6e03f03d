// Pictures in files, in and out.
#pragma once

#include "core/enum_words.h"
#include "image/display.h"
#include "image/image.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace onde {

/// Text attributes stored in a file's header (scene hash, seed, samples, device, version).
using ImageMetadata = std::map<std::string, std::string>;

/// Twice a picture of 16384 x 8192.
inline constexpr uint64_t MOST_PIXELS = uint64_t(1) << 28;

/// Reads PNG, JPEG, OpenEXR, Radiance HDR, WebP, TIFF, TGA, BMP and PFM, whatever the file's name
/// is, as linear floats with 1, 3 or 4 channels. 8- and 16-bit integer files are taken as sRGB and
/// linearised; float files are taken as they are. Throws InputError for a file that is missing,
/// damaged, of another format, or of more than `max_pixels`; the last before it is decoded.
Image read_image(const std::filesystem::path& path, uint64_t max_pixels = MOST_PIXELS);

/// The channels of these names of an OpenEXR, interleaved in that order. Throws InputError like
/// read_image, and where there is none of a name.
Image read_exr(const std::filesystem::path& path, const std::vector<std::string>& names,
               uint64_t max_pixels = MOST_PIXELS);

/// The text attributes of a PNG's or OpenEXR's header; throws InputError like read_image.
ImageMetadata read_image_metadata(const std::filesystem::path& path);

/// Decodes an image file held in memory (the formats of read_image) to RGBA of 8 bits, of 16 where
/// the file has more and they are not a copy of the first 8, or of floats where it has those.
/// `name` is used in error sentences only. Throws InputError like read_image.
TexelImage decode_texels(std::span<const uint8_t> file, const std::string& name,
                         uint64_t max_pixels = MOST_PIXELS);

struct ImageSize {
    uint32_t width = 0, height = 0;
    uint32_t sample_bytes = 1; ///< of a sample in the file; 4 are a float

    uint64_t pixels() const { return uint64_t(width) * height; }
};

/// What decode_texels would make of the file, by its header alone: takes microseconds and no
/// memory. Throws InputError where it would, as far as the header tells.
ImageSize image_size(std::span<const uint8_t> file, const std::string& name,
                     uint64_t max_pixels = MOST_PIXELS);

enum class ExrDepth { half_float, full_float, whole_number };

/// Some channels of a picture of many: of pixel i, image.pixels[k + i * image.channels] is the
/// channel called names[k].
struct ExrLayer {
    Image image;
    std::vector<std::string> names;
    ExrDepth depth = ExrDepth::half_float;
};

/// Writes all channels of layers of the same size as one ZIP-compressed OpenEXR, as write_file
/// does. Values beyond the range of a layer's depth, infinity too, are clamped to it. Throws
/// InputError when the file can't be written, or two channels have one name.
void write_exr(const std::filesystem::path& path, std::span<const ExrLayer> layers,
               const ImageMetadata& metadata);

/// The same of linear RGB (or RGBA, or one-channel) floats alone.
void write_exr(const std::filesystem::path& path, const Image& image, const ImageMetadata& metadata,
               ExrDepth depth = ExrDepth::half_float);

/// Writes an 8-bit sRGB PNG of linear RGB floats, as write_file does.
/// Throws InputError when the file can't be written.
void write_png(const std::filesystem::path& path, const Image& image, const Display& display,
               const ImageMetadata& metadata);

} // namespace onde
