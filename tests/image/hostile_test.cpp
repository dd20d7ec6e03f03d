// Damaged and lying files end in an InputError, whatever they hold.
#include "core/error.h"
#include "core/files.h"
#include "image/image_io.h"
#include "image/scratch.h"
#include "support/assets.h"

#include <catch2/catch.hpp>

#include <sys/resource.h>

#include <array>

using namespace onde;
using onde::test::find_asset;
using onde::test::ScratchFolder;
namespace fs = std::filesystem;

namespace {

TexelImage decode(const std::string& file, const std::string& name = "a.png") {
    return decode_texels({reinterpret_cast<const uint8_t*>(file.data()), file.size()}, name);
}

/// The check sum at the end of a PNG chunk (PNG specification, annex D).
uint32_t crc(const std::string& bytes) {
    uint32_t sum = 0xffffffff;
    for (const char byte : bytes) {
        sum ^= uint8_t(byte);
        for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ (sum & 1 ? 0xedb88320u : 0);
    }
    return ~sum;
}

std::string big_endian(uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

/// A chunk: length, type, data, check sum.
std::string chunk(const std::string& type, const std::string& data) {
    return big_endian(uint32_t(data.size())) + type + data + big_endian(crc(type + data));
}

/// A PNG that claims a size, 8-bit RGB, and holds next to nothing.
std::string png_claiming(uint32_t width, uint32_t height) {
    const std::string header =
        big_endian(width) + big_endian(height) + std::string("\x08\x02\0\0\0", 5);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", "x") + chunk("IEND", "");
}

/// A JPEG start of frame that claims a size; `kind` 0xc0 is baseline, 0xc2 progressive.
std::string jpeg_claiming(uint16_t width, uint16_t height, char kind) {
    std::string file("\xff\xd8\xff", 3);
    file += kind;
    file += std::string("\0\x11\x08", 3);
    file += {char(height >> 8), char(height), char(width >> 8), char(width)};
    file += std::string("\x03\x01\x11\0\x02\x11\0\x03\x11\0", 10);
    file += std::string("\xff\xda\0\x0c\x03\x01\0\x02\0\x03\0\0\x3f\0", 14);
    return file + "\xff\xd9";
}

long peak_memory_kib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

std::string small_png(const ScratchFolder& folder) {
    Image image(64, 64, 3);
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i * 7919 % 256) / 255;
    write_png(folder / "small.png", image, {}, {});
    return read_file(folder / "small.png");
}

/// True when reading ends in a picture or in an InputError; anything else fails the test.
bool read_is_safe(const fs::path& path) {
    try {
        read_image(path);
    } catch (const InputError&) {
    }
    return true;
}

} // namespace

TEST_CASE("a file that is missing, empty, a folder or text is refused with its name") {
    const ScratchFolder folder;
    test::write_bytes(folder / "empty.png", "");
    test::write_bytes(folder / "text.png", "not a picture at all, but long enough to be read");
    for (const char* name : {"missing.png", "empty.png", "text.png", ""}) {
        INFO(name);
        CHECK_THROWS_WITH(read_image(folder / name), Catch::Contains(name));
        CHECK_THROWS_AS(read_image(folder / name), InputError);
        CHECK_THROWS_AS(read_image_metadata(folder / name), InputError);
    }
    CHECK_THROWS_AS(decode(""), InputError);
    CHECK_THROWS_AS(decode("GIF8"), InputError);
}

TEST_CASE("a PNG cut off anywhere is refused, but for its last chunk") {
    const ScratchFolder folder;
    const std::string whole = small_png(folder);
    CHECK_NOTHROW(decode(whole));
    for (size_t size = 0; size + 200 < whole.size(); size += 97) {
        INFO(size << " of " << whole.size() << " bytes");
        CHECK_THROWS_AS(decode(whole.substr(0, size)), InputError);
    }
}

TEST_CASE("a PNG with a flipped bit never escapes as anything but a picture or an InputError") {
    const ScratchFolder folder;
    const std::string whole = small_png(folder);
    for (size_t i = 0; i < whole.size(); i += 53) {
        std::string damaged = whole;
        damaged[i] = char(damaged[i] ^ (1 << (i % 8)));
        test::write_bytes(folder / "damaged.png", damaged);
        INFO("byte " << i);
        CHECK(read_is_safe(folder / "damaged.png"));
    }
}

TEST_CASE("a header that claims an absurd size is refused before its pixels are allocated") {
    const long before = peak_memory_kib();
    CHECK_THROWS_WITH(decode(png_claiming(60000, 60000)), Catch::Contains("60000 x 60000"));
    CHECK_THROWS_AS(decode(png_claiming(0x7fffffff, 1)), InputError);
    CHECK_THROWS_AS(decode(png_claiming(0, 5)), InputError);
    CHECK_THROWS_AS(decode(jpeg_claiming(65000, 65000, '\xc0'), "a.jpg"), InputError);
    CHECK_THROWS_AS(decode(jpeg_claiming(65000, 65000, '\xc2'), "a.jpg"), InputError);
    const long grown = peak_memory_kib() - before;
    INFO("grew by " << grown << " KiB");
    CHECK(grown < 256 * 1024);
}

TEST_CASE("palettes, bit depths and grey all become 8-bit RGBA") {
    struct Case {
        const char* path;
        uint32_t width, height;
    };
    for (const Case& c : {Case{"images/oiio/targa/UBW8.TGA", 128, 128},
                          Case{"images/oiio/targa/CCM8.TGA", 128, 128},
                          Case{"images/oiio/png/oiio-logo-no-alpha.png", 135, 135},
                          Case{"invalid/gltf-validator/base/data/image/npot.png", 5, 3}}) {
        const auto path = find_asset(c.path);
        if (!path) continue;
        INFO(c.path);
        const TexelImage image = decode(read_file(*path), c.path);
        CHECK(image.width == c.width);
        CHECK(image.height == c.height);
        CHECK(image.rgba.size() == 4 * size_t(c.width) * c.height);
    }
}

TEST_CASE("floating-point pictures of other programs are read") {
    for (const char* name : {"images/oiio/pnm/test-1.pfm", "images/oiio/pnm/test-3.pfm",
                             "hdr/simple-rle.hdr", "images/openexr/DisplayWindow/t03.exr"}) {
        const auto path = find_asset(name);
        if (!path) continue;
        INFO(name);
        const Image image = read_image(*path);
        CHECK(image.pixels.size() == size_t(image.width) * image.height * image.channels);
        CHECK(image.width > 0);
    }
}

TEST_CASE("no damaged picture of the collections crashes the reader") {
    for (const char* name : {"images", "invalid/openexr-damaged"}) {
        const auto folder = find_asset(name);
        if (!folder) continue;
        for (const auto& entry : fs::recursive_directory_iterator(*folder)) {
            if (!entry.is_regular_file()) continue;
            INFO(entry.path());
            CHECK(read_is_safe(entry.path()));
        }
    }
}
