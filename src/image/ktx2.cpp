// KTX 2.0 containers (Khronos, "KTX File Format Specification", version 2.0): the first picture of
// plain texels of 8 bits, packed by Zstandard or not, and of Basis Universal by a transcoder.
#include "image/basis.h"
#include "image/stored_image.h"

#include <zstd.h>

#include <algorithm>
#include <array>

namespace onde {
namespace {

using namespace std::literals;

constexpr std::string_view IDENTIFIER = "\xabKTX 20\xbb\r\n\x1a\n"sv;

/// Where the fields of the header stand (section 3.1).
enum Offset : size_t {
    FORMAT = 12,
    WIDTH = 20,
    HEIGHT = 24,
    DEPTH = 28,
    LAYERS = 32,
    FACES = 36,
    SUPERCOMPRESSION = 44,
    LEVEL_OFFSET = 80, ///< of the largest level, which is the first of the list
    LEVEL_BYTES = 88,
    LEVEL_UNPACKED_BYTES = 96,
    HEADER_BYTES = 104
};

uint64_t little_endian(FileBytes file, size_t at, size_t bytes) {
    uint64_t value = 0;
    for (size_t i = bytes; i-- > 0;) value = value << 8 | file[at + i];
    return value;
}

uint32_t word(FileBytes file, Offset at) {
    return uint32_t(little_endian(file, at, 4));
}

/// A VkFormat of 8-bit texels, UNORM or SRGB; `order` says which stored byte is R, G, B and A.
struct TexelFormat {
    uint32_t unorm, srgb;
    uint32_t channels;
    std::array<int, 4> order; ///< -1: 0, and 255 for A
};

constexpr std::array TEXEL_FORMATS{
    TexelFormat{9, 15, 1, {0, -1, -1, -1}}, TexelFormat{16, 22, 2, {0, 1, -1, -1}},
    TexelFormat{23, 29, 3, {0, 1, 2, -1}},  TexelFormat{30, 36, 3, {2, 1, 0, -1}},
    TexelFormat{37, 43, 4, {0, 1, 2, 3}},   TexelFormat{44, 50, 4, {2, 1, 0, 3}}};

const TexelFormat& texel_format(FileBytes file) {
    const uint32_t format = word(file, FORMAT);
    for (const TexelFormat& known : TEXEL_FORMATS)
        if (format == known.unorm || format == known.srgb) return known;
    throw ImageProblem("its texels (VkFormat " + std::to_string(format) +
                       ") are neither of 8 bits nor of Basis Universal");
}

bool is_basis(FileBytes file) {
    return word(file, FORMAT) == 0;
}

/// How the levels are packed (section 3.8).
enum Supercompression : uint32_t { NONE = 0, ZSTANDARD = 2 };

ImageHeader header(FileBytes file) {
    if (file.size() < HEADER_BYTES) throw ImageProblem("the file ends early");
    if (word(file, DEPTH) > 1 || word(file, LAYERS) > 1 || word(file, FACES) != 1)
        throw ImageProblem("it is a volume, an array or a cube map");
    ImageHeader size{word(file, WIDTH), word(file, HEIGHT), 4};
    size.least_bytes = least_bytes_of_any(size.samples());
    return size;
}

/// The bytes of the largest level, as they are stored.
FileBytes stored_level(FileBytes file) {
    const uint64_t at = little_endian(file, LEVEL_OFFSET, 8);
    const uint64_t bytes = little_endian(file, LEVEL_BYTES, 8);
    if (at > file.size() || bytes > file.size() - at) throw ImageProblem("the file ends early");
    return file.subspan(at, bytes);
}

/// Fills `texels` with the largest level.
void read_level(FileBytes file, std::vector<uint8_t>& texels) {
    const FileBytes stored = stored_level(file);
    const uint32_t packing = word(file, SUPERCOMPRESSION);
    const uint64_t bytes =
        packing == ZSTANDARD ? little_endian(file, LEVEL_UNPACKED_BYTES, 8) : stored.size();
    if (bytes != texels.size()) throw ImageProblem("the length of its largest level is wrong");
    if (packing == ZSTANDARD) {
        const size_t got = ZSTD_decompress(texels.data(), bytes, stored.data(), stored.size());
        if (got != bytes) throw ImageProblem("its packed texels are damaged");
    } else if (packing == NONE) {
        std::ranges::copy(stored, texels.begin());
    } else {
        throw ImageProblem("it is packed by scheme " + std::to_string(packing) +
                           ", which is not known");
    }
}

StoredImage decode(FileBytes file) {
    const ImageHeader size = header(file);
    if (is_basis(file))
        return {size.width, size.height, 4, transcode_basis(file, size.width, size.height)};
    const TexelFormat& format = texel_format(file);
    auto texels = samples_of<uint8_t>(size.pixels(), format.channels);
    read_level(file, texels);
    spread_to_rgba(texels, format.channels, format.order);
    return {size.width, size.height, 4, std::move(texels)};
}

bool recognise(FileBytes file) {
    return as_text(file).starts_with(IDENTIFIER);
}

} // namespace

const ImageFormat KTX2_FORMAT{"KTX2", recognise, header, decode, nullptr};

} // namespace onde
