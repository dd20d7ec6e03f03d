#include "image/image_io.h"

#include "core/error.h"
#include "core/files.h"
#include "image/tone.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>

namespace onde {

namespace {

using Input = std::unique_ptr<OIIO::ImageInput>;

constexpr uint64_t MAX_PIXELS = uint64_t(1) << 28;

/// Deflate packs at most 1032 to 1 and no other coding in common use does much better; a header
/// that claims more than this was made to exhaust memory.
constexpr uint64_t MAX_SAMPLES_PER_BYTE = 1 << 14;

constexpr float MAX_HALF = 65504.0f;

/// Pictures are read and written one at a time beside a renderer that owns the cores.
void limit_threads() {
    static const bool done = [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", 4);
        return true;
    }();
    (void)done;
}

/// OpenImageIO's message as the tail of our sentence: one line, no final stop. Takes the message
/// out of the library, which would otherwise print it when the program ends.
std::string reason(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    while (!message.empty() && (message.back() == ' ' || message.back() == '.')) message.pop_back();
    return message.empty() ? "no reason given" : message;
}

[[noreturn]] void throw_unreadable(const std::string& name, const std::string& message) {
    throw InputError("cannot read the image {}: {}; convert it again or name another file", name,
                     reason(message));
}

/// Refuses a picture by its header, before any pixel is allocated. `bytes` is the file's size.
void check_size(const OIIO::ImageSpec& spec, size_t bytes, const std::string& name) {
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        throw_unreadable(name, "its header claims no pixels");
    if (spec.depth > 1 || spec.deep) throw_unreadable(name, "it is a volume or a deep image");
    if (uint64_t(spec.width) * uint64_t(spec.height) > MAX_PIXELS)
        throw InputError("the image {} claims {} x {} pixels, more than the limit of {}; scale it "
                         "down",
                         name, spec.width, spec.height, MAX_PIXELS);
    const uint64_t pixels = std::max(uint64_t(spec.width) * uint64_t(spec.height),
                                     uint64_t(spec.tile_width) * uint64_t(spec.tile_height));
    if (pixels * uint64_t(spec.nchannels) > MAX_SAMPLES_PER_BYTE * bytes)
        throw_unreadable(name, "its header claims far more pixels than its bytes can hold");
}

/// Runs `read` with what the decoders throw, out of memory included, turned into our sentence.
template <class Read>
auto guarded(const std::string& name, Read read) {
    try {
        return read();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw_unreadable(name, error.what());
    }
}

/// Colour is left as stored: without the hint OpenImageIO multiplies it by alpha.
OIIO::ImageSpec reading_hints() {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    return hints;
}

/// Opens a file in memory with the decoder called `format`. The proxy is set on the decoder itself:
/// ImageInput::open would lose it after its trial of the header.
Input open_memory(const std::string& format, OIIO::Filesystem::IOProxy& bytes,
                  const std::string& name) {
    limit_threads();
    Input input = OIIO::ImageInput::create(format);
    if (!input) throw_unreadable(name, OIIO::geterror());
    OIIO::ImageSpec spec;
    const bool opened = input->set_ioproxy(&bytes) && input->open(name, spec, reading_hints());
    const std::string message = input->geterror() + OIIO::geterror();
    if (!opened) throw_unreadable(name, message);
    check_size(input->spec(), bytes.size(), name);
    return input;
}

/// All samples of the first subimage, converted to T: `spec.nchannels` per pixel.
template <class T>
std::vector<T> read_samples(OIIO::ImageInput& input, OIIO::TypeDesc type, const std::string& name) {
    const OIIO::ImageSpec& spec = input.spec();
    std::vector<T> samples(size_t(spec.width) * spec.height * spec.nchannels);
    const bool complete = input.read_image(0, 0, 0, spec.nchannels, type, samples.data());
    const std::string message = input.geterror() + OIIO::geterror();
    if (!complete) throw_unreadable(name, message);
    return samples;
}

/// Which stored channel feeds each channel of the result; -1 is opaque alpha.
using ChannelMap = std::vector<int>;

/// R, G, B and A by name, else by count: grey, grey and alpha, RGB, RGBA.
ChannelMap map_channels(const OIIO::ImageSpec& spec, const std::string& name) {
    const int r = spec.channelindex("R"), g = spec.channelindex("G"), b = spec.channelindex("B");
    if (r >= 0 && g >= 0 && b >= 0) {
        const int a = spec.channelindex("A");
        return a >= 0 ? ChannelMap{r, g, b, a} : ChannelMap{r, g, b};
    }
    switch (spec.nchannels) {
    case 1:
        return {0};
    case 2:
        return {0, 0, 0, 1};
    case 3:
        return {0, 1, 2};
    case 4:
        return {0, 1, 2, 3};
    default:
        throw_unreadable(name, "none of its " + std::to_string(spec.nchannels) +
                                   " channels is called R, G or B");
    }
}

/// Like map_channels, always four.
ChannelMap map_to_rgba(const OIIO::ImageSpec& spec, const std::string& name) {
    ChannelMap map = map_channels(spec, name);
    if (map.size() == 1) map = {map[0], map[0], map[0]};
    if (map.size() == 3) map.push_back(-1);
    return map;
}

template <class T>
std::vector<T> pick_channels(const std::vector<T>& samples, int stored, const ChannelMap& map,
                             T opaque) {
    const size_t pixels = samples.size() / size_t(stored);
    std::vector<T> picked;
    picked.reserve(pixels * map.size());
    for (size_t pixel = 0; pixel < pixels; ++pixel)
        for (const int channel : map)
            picked.push_back(channel < 0 ? opaque : samples[pixel * size_t(stored) + channel]);
    return picked;
}

/// The decoder that fits the content. Only Targa has no signature: there the name decides.
std::optional<std::string> format_of(std::string_view file, std::string_view name) {
    using namespace std::literals;
    constexpr std::array<std::pair<std::string_view, const char*>, 8> SIGNATURES{{
        {"\x89PNG\r\n\x1a\n"sv, "png"},
        {"\xff\xd8\xff"sv, "jpeg"},
        {"RIFF"sv, "webp"},
        {"GIF8"sv, "gif"},
        {"BM"sv, "bmp"},
        {"\x76\x2f\x31\x01"sv, "openexr"},
        {"II*\0"sv, "tiff"},
        {"#?RADIANCE"sv, "hdr"},
    }};
    for (const auto& [signature, format] : SIGNATURES)
        if (file.starts_with(signature)) return format;
    if (name.ends_with(".tga") || name.ends_with(".TGA")) return "targa";
    return std::nullopt;
}

/// Opens a file held in `memory` by its content; what has no signature is left to OpenImageIO,
/// which goes by the extension of `path`.
Input open_file(const std::filesystem::path& path, const std::string& bytes,
                OIIO::Filesystem::IOProxy& memory) {
    const std::string name = path.string();
    if (const auto format = format_of(bytes, name)) return open_memory(*format, memory, name);
    limit_threads();
    const OIIO::ImageSpec hints = reading_hints();
    Input input = OIIO::ImageInput::open(name, &hints);
    if (!input) throw_unreadable(name, OIIO::geterror());
    check_size(input->spec(), bytes.size(), name);
    return input;
}

bool is_integer(const OIIO::ImageSpec& spec) {
    return spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::UINT16;
}

void linearise(Image& image) {
    for (size_t i = 0; i < image.pixels.size(); ++i)
        if (image.channels != 4 || i % 4 != 3) image.pixels[i] = linear_from_srgb(image.pixels[i]);
}

/// The header of a file to be written.
OIIO::ImageSpec make_spec(const Image& image, OIIO::TypeDesc type, const ImageMetadata& metadata) {
    OIIO::ImageSpec spec(int(image.width), int(image.height), int(image.channels), type);
    spec.attribute("oiio:UnassociatedAlpha", 1); // the pixels are stored as they are
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    return spec;
}

void check_channels(const Image& image, const std::filesystem::path& path) {
    if (image.channels != 1 && image.channels != 3 && image.channels != 4)
        throw InputError("{}: a picture of {} channels cannot be written; give 1, 3 or 4",
                         path.string(), image.channels);
}

/// Writes through a temporary file; `samples` are of `type`, `spec` says how they are stored.
void write_file(const std::filesystem::path& path, const std::string& format,
                const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* samples) {
    limit_threads();
    check_writable(path);
    replace_file(path, [&](const std::filesystem::path& temporary) {
        const auto output = OIIO::ImageOutput::create(format);
        const bool written = output && output->open(temporary.string(), spec) &&
                             output->write_image(type, samples) && output->close();
        const std::string message = (output ? output->geterror() : "") + OIIO::geterror();
        if (!written)
            throw InputError("{}: the picture cannot be written: {}; choose another output",
                             path.string(), reason(message));
    });
}

} // namespace

ByteImage decode_byte_image(std::span<const uint8_t> file, const std::string& name) {
    const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
    const auto format = format_of(bytes, name);
    if (!format)
        throw InputError("the image {} is in no known format; store it as PNG or JPEG", name);
    OIIO::Filesystem::IOMemReader memory(file.data(), file.size());
    return guarded(name, [&]() -> ByteImage {
        const Input input = open_memory(*format, memory, name);
        const OIIO::ImageSpec spec = input->spec();
        const ChannelMap map = map_to_rgba(spec, name);
        const auto samples = read_samples<uint8_t>(*input, OIIO::TypeDesc::UINT8, name);
        return {uint32_t(spec.width), uint32_t(spec.height),
                pick_channels(samples, spec.nchannels, map, uint8_t(255))};
    });
}

Image read_image(const std::filesystem::path& path) {
    const std::string bytes = read_file(path), name = path.string();
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    return guarded(name, [&] {
        const Input input = open_file(path, bytes, memory);
        const OIIO::ImageSpec spec = input->spec();
        const ChannelMap map = map_channels(spec, name);
        Image image;
        image.width = uint32_t(spec.width);
        image.height = uint32_t(spec.height);
        image.channels = uint32_t(map.size());
        image.pixels = pick_channels(read_samples<float>(*input, OIIO::TypeDesc::FLOAT, name),
                                     spec.nchannels, map, 1.0f);
        if (is_integer(spec)) linearise(image);
        return image;
    });
}

ImageMetadata read_image_metadata(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    return guarded(path.string(), [&] {
        const Input input = open_file(path, bytes, memory);
        ImageMetadata metadata;
        for (const OIIO::ParamValue& attribute : input->spec().extra_attribs)
            if (attribute.type() == OIIO::TypeDesc::STRING)
                metadata.emplace(attribute.name().string(), attribute.get_string());
        return metadata;
    });
}

void write_exr(const std::filesystem::path& path, const Image& image, const ImageMetadata& metadata,
               ExrDepth depth) {
    check_channels(image, path);
    const bool half = depth == ExrDepth::half_float;
    auto spec = make_spec(image, half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT, metadata);
    spec.attribute("compression", "zip");
    if (!half) return write_file(path, "openexr", spec, OIIO::TypeDesc::FLOAT, image.pixels.data());
    std::vector<float> clamped = image.pixels;
    for (float& value : clamped) value = std::clamp(value, -MAX_HALF, MAX_HALF);
    write_file(path, "openexr", spec, OIIO::TypeDesc::FLOAT, clamped.data());
}

void write_png(const std::filesystem::path& path, const Image& image, const Display& display,
               const ImageMetadata& metadata) {
    check_channels(image, path);
    auto spec = make_spec(image, OIIO::TypeDesc::UINT8, metadata);
    spec.attribute("oiio:ColorSpace", "sRGB");
    const std::vector<uint8_t> bytes = display_bytes(image, display);
    write_file(path, "png", spec, OIIO::TypeDesc::UINT8, bytes.data());
}

} // namespace onde
