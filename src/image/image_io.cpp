#include "image/image_io.h"

#include "core/error.h"
#include "core/files.h"
#include "core/output.h"
#include "image/stored_image.h"
#include "image/tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace onde {
namespace {

/// In the order in which they are tried; Targa has no signature and comes last.
constexpr std::array FORMATS{&PNG_FORMAT,  &JPEG_FORMAT, &EXR_FORMAT, &HDR_FORMAT,  &WEBP_FORMAT,
                             &TIFF_FORMAT, &BMP_FORMAT,  &PFM_FORMAT, &KTX2_FORMAT, &TGA_FORMAT};

const ImageFormat& format_of(FileBytes file, const std::string& name) {
    for (const ImageFormat* format : FORMATS)
        if (format->recognise(file)) return *format;
    throw InputError("the image {} is in no format that is read; store it as PNG, JPEG or OpenEXR",
                     name);
}

/// Runs `read` with what the decoders throw, out of memory included, turned into our sentence.
template <class Read>
auto guarded(const std::string& name, Read read) {
    try {
        return read();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError("cannot read the image {}: {}; convert it again or name another file",
                         name, error.what());
    }
}

/// The header, once it is known that its picture can be decoded within the limit.
ImageHeader acceptable_header(const ImageFormat& format, FileBytes file, const std::string& name,
                              uint64_t max_pixels) {
    const ImageHeader header = format.header(file);
    if (header.samples() == 0) throw ImageProblem("its header claims no pixels");
    if (header.pixels() > max_pixels)
        throw InputError("the image {} claims {} x {} pixels, more than the limit of {}; scale it "
                         "down",
                         name, header.width, header.height, max_pixels);
    if (header.least_bytes > file.size())
        throw ImageProblem("its header claims far more pixels than its bytes can hold");
    return header;
}

StoredImage decode(FileBytes file, const std::string& name, uint64_t max_pixels) {
    const ImageFormat& format = format_of(file, name);
    acceptable_header(format, file, name, max_pixels);
    return format.decode(file);
}

float as_float(uint8_t value) {
    return linear_from_srgb(float(value) / 255);
}
float as_float(uint16_t value) {
    return linear_from_srgb(float(value) / 65535);
}
float as_float(float value) {
    return value;
}

float alpha_as_float(float value) {
    return value;
}
template <class T>
float alpha_as_float(T value) {
    return float(value) / float(std::numeric_limits<T>::max());
}

/// What is infinite becomes the largest number of a half.
float within_range(float value) {
    if (std::isinf(value) && value > 0) return 65504.0f;
    return value > 0 ? value : 0.0f; // NaN is 0
}

/// Which stored channel feeds each of R, G, B and A; -1 is opaque.
std::array<int, 4> rgba_of(uint32_t channels) {
    if (channels == 1) return {0, 0, 0, -1};
    if (channels == 2) return {0, 0, 0, 1};
    return channels == 3 ? std::array{0, 1, 2, -1} : std::array{0, 1, 2, 3};
}

TexelImage rgba_image(const StoredImage& stored, std::vector<uint8_t> samples) {
    if (stored.channels != 4) spread_to_rgba(samples, stored.channels, rgba_of(stored.channels));
    return {stored.width, stored.height, std::move(samples)};
}

/// Samples of 16 bits, or of 8 where the lower ones only repeat them.
TexelImage rgba_image(const StoredImage& stored, const std::vector<uint16_t>& samples) {
    const std::array<int, 4> map = rgba_of(stored.channels);
    TexelImage image{stored.width, stored.height, {}};
    image.rgba.reserve(samples.size() / stored.channels * 4);
    const bool wide = std::ranges::any_of(samples, [](uint16_t s) { return s % 257 != 0; });
    if (wide) image.low.reserve(image.rgba.capacity());
    for (size_t at = 0; at < samples.size(); at += stored.channels)
        for (const int channel : map) {
            const uint16_t value = channel < 0 ? uint16_t(65535) : samples[at + size_t(channel)];
            image.rgba.push_back(uint8_t(value >> 8));
            if (wide) image.low.push_back(uint8_t(value));
        }
    return image;
}

TexelImage rgba_image(const StoredImage& stored, const std::vector<float>& samples) {
    const std::array<int, 4> map = rgba_of(stored.channels);
    TexelImage image{stored.width, stored.height, {}};
    image.floats.reserve(samples.size() / stored.channels * 4);
    for (size_t at = 0; at < samples.size(); at += stored.channels) {
        const std::span pixel = std::span(samples).subspan(at, stored.channels);
        image.cut += std::ranges::any_of(pixel, [](float s) { return within_range(s) != s; });
        for (const int channel : map)
            image.floats.push_back(channel < 0 ? 1.0f : within_range(pixel[size_t(channel)]));
        image.floats.back() = std::min(image.floats.back(), 1.0f);
    }
    return image;
}

/// One channel, three or four, as many as tell all that is stored.
template <class T>
std::vector<float> linear_floats(std::vector<T> samples, uint32_t channels) {
    if constexpr (std::is_same_v<T, float>)
        if (channels != 2) return samples;
    const std::array<int, 4> map = rgba_of(channels);
    const size_t kept = channels == 2 ? 4 : channels;
    std::vector<float> pixels;
    pixels.reserve(samples.size() / channels * kept);
    for (size_t at = 0; at < samples.size(); at += channels)
        for (size_t i = 0; i < kept; ++i) {
            const T value = samples[at + size_t(map[i])];
            pixels.push_back(i == 3 ? alpha_as_float(value) : as_float(value));
        }
    return pixels;
}

FileBytes as_bytes(const std::string& file) {
    return {reinterpret_cast<const uint8_t*>(file.data()), file.size()};
}

void check_shape(const Image& image, const std::filesystem::path& path) {
    if (image.channels != 1 && image.channels != 3 && image.channels != 4)
        throw InputError("{}: a picture of {} channels cannot be written; give 1, 3 or 4",
                         path.string(), image.channels);
    if (image.pixels.empty())
        throw InputError("{}: a picture without pixels cannot be written", path.string());
}

} // namespace

TexelImage decode_texels(std::span<const uint8_t> file, const std::string& name,
                         uint64_t max_pixels) {
    return guarded(name, [&]() -> TexelImage {
        StoredImage stored = decode(file, name, max_pixels);
        return std::visit([&](auto& samples) { return rgba_image(stored, std::move(samples)); },
                          stored.samples);
    });
}

ImageSize image_size(std::span<const uint8_t> file, const std::string& name, uint64_t max_pixels) {
    return guarded(name, [&]() -> ImageSize {
        const ImageHeader header = acceptable_header(format_of(file, name), file, name, max_pixels);
        return {header.width, header.height, header.sample_bytes};
    });
}

Image read_image(const std::filesystem::path& path, uint64_t max_pixels) {
    const std::string file = read_file(path), name = path.string();
    return guarded(name, [&] {
        StoredImage stored = decode(as_bytes(file), name, max_pixels);
        Image image;
        image.width = stored.width;
        image.height = stored.height;
        image.channels = stored.channels == 2 ? 4 : stored.channels;
        image.pixels = std::visit(
            [&](auto& samples) { return linear_floats(std::move(samples), stored.channels); },
            stored.samples);
        return image;
    });
}

Image read_exr(const std::filesystem::path& path, const std::vector<std::string>& names,
               uint64_t max_pixels) {
    const std::string file = read_file(path), name = path.string();
    return guarded(name, [&] {
        if (&format_of(as_bytes(file), name) != &EXR_FORMAT)
            throw ImageProblem("it is no OpenEXR file");
        acceptable_header(EXR_FORMAT, as_bytes(file), name, max_pixels);
        StoredImage stored = decode_exr(as_bytes(file), names);
        Image image;
        image.width = stored.width;
        image.height = stored.height;
        image.channels = stored.channels;
        image.pixels = std::get<std::vector<float>>(std::move(stored.samples));
        return image;
    });
}

ImageMetadata read_image_metadata(const std::filesystem::path& path) {
    const std::string file = read_file(path), name = path.string();
    return guarded(name, [&]() -> ImageMetadata {
        const ImageFormat& format = format_of(as_bytes(file), name);
        return format.metadata ? format.metadata(as_bytes(file)) : ImageMetadata{};
    });
}

void write_png(const std::filesystem::path& path, const Image& image, const Display& display,
               const ImageMetadata& metadata) {
    check_shape(image, path);
    write_file(path, encode_png(display_bytes(image, display), image.width, image.height,
                                image.channels, metadata));
}

} // namespace onde
