// OpenEXR by its own library, written to memory: any channels under any names.
#include "core/error.h"
#include "core/output.h"
#include "image/exr_threads.h"
#include "image/image_io.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <limits>

namespace onde {
namespace {

using Imf::Header;

constexpr float MAX_HALF = 65504.0f, MAX_FLOAT = std::numeric_limits<float>::max();
constexpr float MAX_WHOLE = 4294967040.0f; // the largest float below 2^32

class MemoryOut : public Imf::OStream {
  public:
    MemoryOut() : OStream("memory") {}

    void write(const char from[], int count) override {
        if (at_ + size_t(count) > bytes.size()) bytes.resize(at_ + size_t(count));
        std::memcpy(bytes.data() + at_, from, size_t(count));
        at_ += size_t(count);
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t at) override { at_ = at; }

    std::string bytes;

  private:
    size_t at_ = 0;
};

/// What is read row by row while a file is written: the channels, and their samples where those
/// are converted.
struct Source {
    Imf::ChannelList channels;
    Imf::FrameBuffer buffer;
    std::deque<std::vector<Imath::half>> halves;
    std::deque<std::vector<float>> floats;
    std::deque<std::vector<uint32_t>> naturals;
};

constexpr Imf::PixelType pixel_type(Imath::half) {
    return Imf::HALF;
}
constexpr Imf::PixelType pixel_type(float) {
    return Imf::FLOAT;
}
constexpr Imf::PixelType pixel_type(uint32_t) {
    return Imf::UINT;
}

/// Adds a layer of samples of type T, which hold `least` to `most`.
template <class T>
void add_layer(Source& source, std::deque<std::vector<T>>& kept, const ExrLayer& layer, float least,
               float most) {
    const Image& image = layer.image;
    std::vector<T>& samples = kept.emplace_back();
    samples.reserve(image.pixels.size());
    for (const float value : image.pixels) samples.push_back(T(std::clamp(value, least, most)));
    const size_t stride = sizeof(T) * image.channels, row = stride * image.width;
    T* first = samples.data();
    for (const std::string& name : layer.names) {
        if (source.channels.findChannel(name))
            throw InputError("two channels of a picture are called {}; rename one", name);
        source.channels.insert(name, Imf::Channel(pixel_type(T())));
        source.buffer.insert(
            name, Imf::Slice(pixel_type(T()), reinterpret_cast<char*>(first++), stride, row));
    }
}

std::string encode(std::span<const ExrLayer> layers, const ImageMetadata& metadata) {
    limit_exr_threads();
    Source source;
    for (const ExrLayer& layer : layers) switch (layer.depth) {
        case ExrDepth::half_float:
            add_layer(source, source.halves, layer, -MAX_HALF, MAX_HALF);
            break;
        case ExrDepth::full_float:
            add_layer(source, source.floats, layer, -MAX_FLOAT, MAX_FLOAT);
            break;
        case ExrDepth::whole_number:
            add_layer(source, source.naturals, layer, 0.0f, MAX_WHOLE);
            break;
        }
    const uint32_t height = layers.front().image.height;
    Header header(int(layers.front().image.width), int(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels() = source.channels;
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    MemoryOut memory;
    {
        Imf::OutputFile output(memory, header); // complete when it is destroyed
        output.setFrameBuffer(source.buffer);
        output.writePixels(int(height));
    }
    return std::move(memory.bytes);
}

std::vector<std::string> color_names(uint32_t channels) {
    if (channels == 1) return {"Y"};
    return channels == 4 ? std::vector<std::string>{"R", "G", "B", "A"}
                         : std::vector<std::string>{"R", "G", "B"};
}

void check_layers(std::span<const ExrLayer> layers, const std::filesystem::path& path) {
    for (const ExrLayer& layer : layers) {
        const Image &image = layer.image, &first = layers.front().image;
        if (image.pixels.empty() || image.channels != layer.names.size())
            throw InputError("{}: a picture of {} channels with {} names cannot be written",
                             path.string(), image.channels, layer.names.size());
        if (image.width != first.width || image.height != first.height)
            throw InputError("{}: layers of {}x{} and {}x{} pixels cannot lie in one file",
                             path.string(), first.width, first.height, image.width, image.height);
    }
}

} // namespace

void write_exr(const std::filesystem::path& path, std::span<const ExrLayer> layers,
               const ImageMetadata& metadata) {
    check_layers(layers, path);
    write_file(path, encode(layers, metadata));
}

void write_exr(const std::filesystem::path& path, const Image& image, const ImageMetadata& metadata,
               ExrDepth depth) {
    const ExrLayer layer{image, color_names(image.channels), depth};
    write_exr(path, std::span(&layer, 1), metadata);
}

} // namespace onde
