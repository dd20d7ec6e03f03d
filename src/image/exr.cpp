// OpenEXR by its own library, read from files in memory. Pixels are read as floats.
#include "image/exr_threads.h"
#include "image/stored_image.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>
#include <ImfXdr.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace onde {
namespace {

using Imf::Header;
using Imf::InputFile;

class MemoryIn : public Imf::IStream {
  public:
    explicit MemoryIn(FileBytes file) : IStream("memory"), file_(file) {}

    bool isMemoryMapped() const override { return false; }
    bool read(char to[], int count) override {
        if (count < 0 || size_t(count) > file_.size() - at_)
            throw ImageProblem("the file ends early");
        std::memcpy(to, file_.data() + at_, size_t(count));
        at_ += size_t(count);
        return at_ < file_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t at) override {
        if (at > file_.size()) throw ImageProblem("it points beyond its end");
        at_ = at;
    }

  private:
    FileBytes file_;
    size_t at_ = 0;
};

/// What comes before R, G and B in the names of the picture's own channels, as Blender writes
/// them.
std::string layer_of_picture(const std::vector<std::string>& names) {
    constexpr std::string_view RED = ".Combined.R";
    for (const std::string& name : names)
        if (name.ends_with(RED)) return name.substr(0, name.size() - 1);
    return "";
}

/// The channels to read, in the order of a StoredImage: R, G, B and A by name, else up to four as
/// they are stored.
std::vector<std::string> picture_channels(const Imf::ChannelList& list) {
    std::vector<std::string> names;
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw ImageProblem("its colours are subsampled");
        names.emplace_back(channel.name());
    }
    const std::string layer = list.findChannel("R") ? "" : layer_of_picture(names);
    std::vector<std::string> colors{layer + "R", layer + "G", layer + "B"};
    if (std::ranges::all_of(colors,
                            [&](auto& name) { return list.findChannel(name) != nullptr; })) {
        if (list.findChannel(layer + "A")) colors.push_back(layer + "A");
        return colors;
    }
    if (list.findChannel("Y"))
        return list.findChannel("A") ? std::vector<std::string>{"Y", "A"}
                                     : std::vector<std::string>{"Y"};
    constexpr size_t MOST_WITHOUT_NAMES = 4;
    if (names.empty() || names.size() > MOST_WITHOUT_NAMES)
        throw ImageProblem("none of its " + std::to_string(names.size()) +
                           " channels is called R, G or B");
    return names;
}

/// Its first part, unless that is deep.
ImageHeader read_header(const Header& header) {
    if (header.hasType() && Imf::isDeepData(header.type()))
        throw ImageProblem("it is a deep image");
    const Imath::Box2i window = header.dataWindow();
    const int64_t width = int64_t(window.max.x) - window.min.x + 1;
    const int64_t height = int64_t(window.max.y) - window.min.y + 1;
    constexpr int64_t MOST = std::numeric_limits<int>::max();
    if (width < 1 || height < 1 || width > MOST || height > MOST)
        throw ImageProblem("its header claims no pixels");
    ImageHeader size{uint32_t(width), uint32_t(height),
                     uint32_t(picture_channels(header.channels()).size())};
    size.sample_bytes = sizeof(float);
    const Imf::Compression coding = header.compression();
    const bool lossy = coding == Imf::DWAA_COMPRESSION || coding == Imf::DWAB_COMPRESSION;
    constexpr uint64_t LEAST_SAMPLE = 2;
    size.least_bytes =
        lossy ? least_bytes_of_any(size.samples()) : size.samples() * LEAST_SAMPLE / MOST_DEFLATED;
    if (header.hasTileDescription()) {
        const Imf::TileDescription& tile = header.tileDescription();
        const uint64_t samples = uint64_t(tile.xSize) * tile.ySize * size.channels;
        size.least_bytes = std::max(size.least_bytes, least_bytes_of_any(samples));
    }
    return size;
}

/// The attributes of a header begin with their size, which the library allocates unseen.
void check_attribute_sizes(FileBytes file) {
    constexpr size_t MAGIC_AND_VERSION = 8, SIZE = 4;
    std::string_view rest = as_text(file).substr(std::min(file.size(), MAGIC_AND_VERSION));
    const auto skip_word = [&rest] {
        const size_t end = rest.find('\0');
        if (end == std::string_view::npos) throw ImageProblem("the file ends early");
        rest.remove_prefix(end + 1);
    };
    while (!rest.starts_with('\0')) {
        skip_word(); // its name
        skip_word(); // its type
        if (rest.size() < SIZE) throw ImageProblem("the file ends early");
        uint32_t size = 0;
        for (size_t i = 0; i < SIZE; ++i) size |= uint32_t(uint8_t(rest[i])) << (8 * i);
        rest.remove_prefix(SIZE);
        if (size > rest.size()) throw ImageProblem("its header claims more bytes than it has");
        rest.remove_prefix(size);
    }
}

/// The file's first header alone, before the tables that follow it.
Header first_header(FileBytes file) {
    check_attribute_sizes(file);
    MemoryIn memory(file);
    int magic = 0, version = 0;
    Imf::Xdr::read<Imf::StreamIO>(memory, magic);
    Imf::Xdr::read<Imf::StreamIO>(memory, version);
    Header header;
    header.readFrom(memory, version);
    return header;
}

ImageHeader header(FileBytes file) {
    return read_header(first_header(file));
}

/// The channels of these names, interleaved.
StoredImage read_channels(InputFile& input, const std::vector<std::string>& names) {
    const ImageHeader size = read_header(input.header());
    const Imath::Box2i window = input.header().dataWindow();
    const auto channels = uint32_t(names.size());
    std::vector<float> pixels(size_t(size.width) * size.height * channels);
    const size_t stride = sizeof(float) * channels, row = stride * size.width;
    Imf::FrameBuffer target;
    size_t index = 0;
    for (const std::string& name : names)
        target.insert(name, Imf::Slice::Make(Imf::FLOAT, pixels.data() + index++, window.min,
                                             size.width, size.height, stride, row));
    input.setFrameBuffer(target);
    input.readPixels(window.min.y, window.max.y);
    return {size.width, size.height, channels, std::move(pixels)};
}

StoredImage decode(FileBytes file) {
    limit_exr_threads();
    MemoryIn memory(file);
    InputFile input(memory);
    return read_channels(input, picture_channels(input.header().channels()));
}

ImageMetadata metadata(FileBytes file) {
    const Header header = first_header(file);
    ImageMetadata all;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
            all.emplace(attribute.name(), text->value());
    return all;
}

bool recognise(FileBytes file) {
    return as_text(file).starts_with("\x76\x2f\x31\x01");
}

} // namespace

const ImageFormat EXR_FORMAT{"OpenEXR", recognise, header, decode, metadata};

StoredImage decode_exr(FileBytes file, const std::vector<std::string>& names) {
    limit_exr_threads();
    MemoryIn memory(file);
    InputFile input(memory);
    for (const std::string& name : names)
        if (!input.header().channels().findChannel(name))
            throw ImageProblem("it has no channel " + name);
    return read_channels(input, names);
}

} // namespace onde
