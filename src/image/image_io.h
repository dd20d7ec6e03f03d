// Pictures in files. The only door to OpenImageIO: nothing else includes it.
#pragma once

#include "core/enum_words.h"
#include "image/display.h"
#include "image/image.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace onde {

/// Text attributes stored in a file's header (scene hash, seed, samples, device, version).
using ImageMetadata = std::map<std::string, std::string>;

/// Reads any format OpenImageIO knows as linear floats with 1, 3 or 4 channels. 8- and 16-bit
/// integer files are taken as sRGB and linearised; float files are taken as they are.
/// Throws InputError for a missing, damaged or absurdly large file (over 2^28 pixels).
Image read_image(const std::filesystem::path& path);

/// The text attributes of a file's header; throws InputError like read_image.
ImageMetadata read_image_metadata(const std::filesystem::path& path);

/// Decodes an image file held in memory (PNG, JPEG, ...) to 8-bit RGBA. `name` is used in error
/// sentences only. Throws InputError.
ByteImage decode_byte_image(std::span<const uint8_t> file, const std::string& name);

enum class ExrDepth { half_float, full_float };

/// Writes linear RGB (or RGBA, or one-channel) floats as ZIP-compressed OpenEXR, by way of
/// a temporary file and a rename. Values beyond half range are clamped to it when depth is half.
/// Throws InputError when the file can't be written.
void write_exr(const std::filesystem::path& path, const Image& image, const ImageMetadata& metadata,
               ExrDepth depth = ExrDepth::half_float);

/// Writes an 8-bit sRGB PNG of linear RGB floats, by way of a temporary file and a rename.
/// Throws InputError when the file can't be written.
void write_png(const std::filesystem::path& path, const Image& image, const Display& display,
               const ImageMetadata& metadata);

} // namespace onde
