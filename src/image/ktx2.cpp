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

std::vector<uint8_t> unpack(FileBytes packed, size_t bytes) {
    std::vector<uint8_t> unpacked(bytes);
    const size_t got = ZSTD_decompress(unpacked.data(), bytes, packed.data(), packed.size());
    if (got != bytes) throw ImageProblem("its packed texels are damaged");
    return unpacked;
}

std::vector<uint8_t> rgba_of(FileBytes texels, const TexelFormat& format) {
    std::vector<uint8_t> rgba;
    rgba.reserve(texels.size() / format.channels * 4);
    for (size_t at = 0; at < texels.size(); at += format.channels)
        for (size_t c = 0; c < 4; ++c)
            rgba.push_back(format.order[c] >= 0 ? texels[at + size_t(format.order[c])]
                                                : uint8_t(c == 3 ? 255 : 0));
    return rgba;
}

StoredImage decode(FileBytes file) {
    const ImageHeader size = header(file);
    if (is_basis(file))
        return {size.width, size.height, 4, transcode_basis(file, size.width, size.height)};
    const TexelFormat& format = texel_format(file);
    const uint64_t bytes = size.pixels() * format.channels;
    const uint32_t packing = word(file, SUPERCOMPRESSION);
    FileBytes texels = stored_level(file);
    std::vector<uint8_t> unpacked;
    if (packing == ZSTANDARD) {
        if (little_endian(file, LEVEL_UNPACKED_BYTES, 8) != bytes)
            throw ImageProblem("the length of its largest level is wrong");
        texels = unpacked = unpack(texels, bytes);
    } else if (packing != NONE) {
        throw ImageProblem("it is packed by scheme " + std::to_string(packing) +
                           ", which is not known");
    }
    if (texels.size() != bytes) throw ImageProblem("the length of its largest level is wrong");
    return {size.width, size.height, 4, rgba_of(texels, format)};
}

bool recognise(FileBytes file) {
    return as_text(file).starts_with(IDENTIFIER);
}

} // namespace

const ImageFormat KTX2_FORMAT{"KTX2", recognise, header, decode, nullptr};

} // namespace onde
