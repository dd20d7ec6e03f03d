// A picture of every format that is read, made here: its pixels come back, cut off it is refused.
#include "core/error.h"
#include "image/image_io.h"
#include "image/scratch.h"
#include "support/assets.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstring>

#include <jpeglib.h>
#include <png.h>
#include <tiffio.h>
#include <webp/encode.h>
#include <zstd.h>

using namespace onde;
using namespace std::literals;
using onde::test::ScratchFolder;

namespace {

/// Two rows of three pixels, each different.
constexpr uint32_t WIDTH = 3, HEIGHT = 2;
const std::vector<uint8_t> RGB{255, 0,  0,  0,   255, 0,   0,   0,   255,
                               10,  20, 30, 128, 128, 128, 250, 200, 5};
const std::vector<uint8_t> RGBA{255, 0,  0,  255, 0,   255, 0,   200, 0,   0,   255, 100,
                                10,  20, 30, 0,   128, 128, 128, 1,   250, 200, 5,   255};

std::vector<uint8_t> opaque(const std::vector<uint8_t>& rgb) {
    std::vector<uint8_t> rgba;
    for (size_t i = 0; i < rgb.size(); i += 3)
        rgba.insert(rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 255});
    return rgba;
}

std::span<const uint8_t> bytes_of(const std::string& file) {
    return {reinterpret_cast<const uint8_t*>(file.data()), file.size()};
}

TexelImage decode(const std::string& file) {
    return decode_texels(bytes_of(file), "a picture");
}

std::string text_of(const std::vector<uint8_t>& bytes) {
    return {bytes.begin(), bytes.end()};
}

std::string little_endian(uint64_t value, size_t bytes) {
    std::string text;
    for (size_t i = 0; i < bytes; ++i) text += char(value >> 8 * i);
    return text;
}

/// Its size by its header, its pixels, and an error for every part of it that is too short.
void check_reads(const std::string& file, const std::vector<uint8_t>& rgba, size_t spare = 0) {
    const ImageSize size = image_size(bytes_of(file), "a picture");
    CHECK(size.width == WIDTH);
    CHECK(size.height == HEIGHT);
    const TexelImage image = decode(file);
    CHECK(image.width == WIDTH);
    CHECK(image.height == HEIGHT);
    CHECK(image.rgba == rgba);
    CHECK_THROWS_WITH(decode_texels(bytes_of(file), "a picture", 5), Catch::Contains("limit of 5"));
    for (size_t cut = 0; cut + spare < file.size(); ++cut) {
        INFO(cut << " of " << file.size() << " bytes");
        CHECK_THROWS_AS(decode(file.substr(0, cut)), InputError);
    }
}

/// Blue first, the last row first, rows of a multiple of four bytes.
std::string bmp_file() {
    std::string rows;
    for (uint32_t y = HEIGHT; y-- > 0;) {
        for (uint32_t x = 0; x < WIDTH; ++x)
            for (int c = 2; c >= 0; --c) rows += char(RGB[(y * WIDTH + x) * 3 + size_t(c)]);
        rows.append(3, '\0');
    }
    return "BM" + little_endian(54 + rows.size(), 4) + little_endian(0, 4) + little_endian(54, 4) +
           little_endian(40, 4) + little_endian(WIDTH, 4) + little_endian(HEIGHT, 4) +
           little_endian(1, 2) + little_endian(24, 2) + std::string(24, '\0') + rows;
}

/// Blue first; runs of one different pixel each where it is packed.
std::string tga_file(bool packed, const std::vector<uint8_t>& rgba) {
    std::string pixels;
    for (size_t i = 0; i < rgba.size(); i += 4) {
        if (packed) pixels += '\0';
        for (const size_t c : {2, 1, 0, 3}) pixels += char(rgba[i + c]);
    }
    constexpr char TOP_DOWN_WITH_ALPHA = 0x28;
    return "\0\0"s + char(packed ? 10 : 2) + std::string(9, '\0') + little_endian(WIDTH, 2) +
           little_endian(HEIGHT, 2) + char(32) + TOP_DOWN_WITH_ALPHA + pixels;
}

std::string webp_file() {
    uint8_t* file = nullptr;
    const size_t size = WebPEncodeLosslessRGBA(RGBA.data(), WIDTH, HEIGHT, WIDTH * 4, &file);
    const std::string text(reinterpret_cast<const char*>(file), size);
    WebPFree(file);
    return text;
}

/// `colours` per pixel, of the highest quality.
std::string jpeg_file(const std::vector<uint8_t>& samples, int channels, J_COLOR_SPACE colours,
                      uint32_t width = WIDTH, uint32_t height = HEIGHT) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* file = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &file, &size);
    jpeg.image_width = width;
    jpeg.image_height = height;
    jpeg.input_components = channels;
    jpeg.in_color_space = colours;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    for (uint32_t y = 0; y < height; ++y) {
        auto* row = const_cast<JSAMPROW>(samples.data() + size_t(y) * width * size_t(channels));
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    const std::string text(reinterpret_cast<const char*>(file), size);
    jpeg_destroy_compress(&jpeg);
    std::free(file);
    return text;
}

template <class T>
std::string tiff_file(const ScratchFolder& folder, const std::vector<T>& samples, uint16_t channels,
                      uint16_t format, uint16_t compression = COMPRESSION_NONE) {
    const std::string path = folder / "a.tiff";
    TIFF* file = TIFFOpen(path.c_str(), "w");
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, WIDTH);
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, HEIGHT);
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, channels);
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, uint16_t(8 * sizeof(T)));
    TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, format);
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC,
                 channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(file, TIFFTAG_COMPRESSION, compression);
    const uint16_t straight = EXTRASAMPLE_UNASSALPHA;
    if (channels == 4) TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, &straight);
    std::vector<T> rows = samples;
    for (uint32_t y = 0; y < HEIGHT; ++y)
        TIFFWriteScanline(file, rows.data() + size_t(y) * WIDTH * channels, y);
    TIFFClose(file);
    return onde::test::read_bytes(path);
}

std::string ktx2_file(uint32_t format, uint32_t packing, const std::string& texels,
                      size_t unpacked) {
    std::string file = "\xabKTX 20\xbb\r\n\x1a\n"s;
    for (const uint32_t word : {format, 1u, WIDTH, HEIGHT, 0u, 0u, 1u, 1u, packing, 0u, 0u, 0u, 0u})
        file += little_endian(word, 4);
    file += std::string(16, '\0'); // no supercompression global data
    for (const uint64_t word : {uint64_t(104), uint64_t(texels.size()), uint64_t(unpacked)})
        file += little_endian(word, 8);
    return file + texels;
}

std::string zstandard(const std::string& texels) {
    std::string packed(ZSTD_compressBound(texels.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), texels.data(), texels.size(), 3));
    return packed;
}

std::string png16_file(const std::vector<uint16_t>& grey) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = WIDTH;
    image.height = HEIGHT;
    image.format = PNG_FORMAT_LINEAR_Y;
    std::string file(1000, '\0');
    png_alloc_size_t size = file.size();
    REQUIRE(png_image_write_to_memory(&image, file.data(), &size, 0, grey.data(), 0, nullptr));
    return file.substr(0, size);
}

Image read(const ScratchFolder& folder, const std::string& file) {
    test::write_bytes(folder / "a picture", file);
    return read_image(folder / "a picture");
}

} // namespace

TEST_CASE("BMP is read") {
    check_reads(bmp_file(), opaque(RGB), 6);
}

TEST_CASE("TGA is read, plain and packed") {
    check_reads(tga_file(false, RGBA), RGBA, 12);
    check_reads(tga_file(true, RGBA), RGBA, 3);
}

TEST_CASE("WebP is read with its alpha") {
    std::vector<uint8_t> expected = RGBA;
    std::fill_n(expected.begin() + 12, 3, uint8_t(0)); // its encoder drops colour under no alpha
    check_reads(webp_file(), expected, 2);
}

TEST_CASE("JPEG is read in colour, grey and four inks") {
    const std::vector<uint8_t> grey{0, 60, 120, 180, 240, 255};
    const TexelImage picture = decode(jpeg_file(grey, 1, JCS_GRAYSCALE));
    for (size_t i = 0; i < grey.size(); ++i)
        CHECK(picture.rgba[4 * i] == Approx(grey[i]).margin(2));
    std::vector<uint8_t> flat, inks;
    for (int i = 0; i < 64; ++i) {
        flat.insert(flat.end(), {200, 100, 50});
        inks.insert(inks.end(), {55, 155, 205, 0}); // what is not inverted by Adobe
    }
    for (const std::string& file :
         {jpeg_file(flat, 3, JCS_RGB, 8, 8), jpeg_file(inks, 4, JCS_CMYK, 8, 8)}) {
        const TexelImage colour = decode(file);
        CHECK(colour.width == 8);
        const bool adobe = file.find("Adobe") != std::string::npos;
        const int expected = adobe ? 0 : 200; // libjpeg marks inks as Adobe's: no light at K 0
        CHECK(int(colour.rgba[0]) == Approx(expected).margin(3));
        CHECK(int(colour.rgba[3]) == 255);
    }
    const std::string file = jpeg_file(flat, 3, JCS_RGB, 8, 8);
    for (size_t cut = 0; cut + 8 < file.size(); ++cut)
        CHECK_THROWS_AS(decode(file.substr(0, cut)), InputError);
}

TEST_CASE("TIFF is read in 8 bits, 16 bits and floats, packed or not") {
    const ScratchFolder folder;
    check_reads(tiff_file(folder, RGB, 3, SAMPLEFORMAT_UINT), opaque(RGB));
    check_reads(tiff_file(folder, RGBA, 4, SAMPLEFORMAT_UINT, COMPRESSION_LZW), RGBA);
    const std::vector<uint16_t> grey16{0, 257, 65535, 32896, 514, 25700};
    const TexelImage bytes = decode(tiff_file(folder, grey16, 1, SAMPLEFORMAT_UINT));
    CHECK(bytes.rgba[4] == 1);
    CHECK(bytes.low.empty()); // they only repeat the higher bytes
    const std::vector<uint16_t> rgb16{0, 1, 65535, 300, 258, 9, 1, 2, 3,
                                      4, 5, 6,     7,   8,   9, 0, 1, 65534};
    const std::string file = tiff_file(folder, rgb16, 3, SAMPLEFORMAT_UINT);
    const TexelImage wide = decode(file);
    CHECK(image_size(bytes_of(file), "a picture").sample_bytes == 2);
    for (size_t pixel = 0; pixel < 6; ++pixel) {
        for (size_t c = 0; c < 3; ++c) CHECK(wide.code(4 * pixel + c) == rgb16[3 * pixel + c]);
        CHECK(wide.code(4 * pixel + 3) == 65535);
    }
    const std::vector<float> floats{0, 1e-3f, 1, 1e4f, -2, 0.5f};
    CHECK(read(folder, tiff_file(folder, floats, 1, SAMPLEFORMAT_IEEEFP)).pixels == floats);
}

TEST_CASE("16-bit PNG is kept") {
    const ScratchFolder folder;
    const std::vector<uint16_t> grey{0, 257, 65535, 300, 32896, 65535};
    const std::string file = png16_file(grey);
    const TexelImage wide = decode(file);
    for (size_t i = 0; i < grey.size(); ++i) CHECK(wide.code(4 * i + 1) == grey[i]);
    CHECK(wide.code(3) == 65535);
    const Image image = read(folder, file);
    CHECK(image.channels == 1);
    CHECK(image.pixels[2] == 1.0f);
    CHECK(image.pixels[1] > 0.0f);
    CHECK(image.pixels[3] > image.pixels[1]); // the same in 8 bits
}

TEST_CASE("PFM is read in both orders of bytes, from the bottom row") {
    const ScratchFolder folder;
    const std::vector<float> rows{1, 2, 3, 4, 5, -6.5f};
    std::string little = "Pf\n3 2\n-1.0\n", big = "Pf\n3 2\n1.0\n";
    for (const float value : rows) {
        uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        const std::string word = little_endian(bits, 4);
        little += word;
        big += std::string(word.rbegin(), word.rend());
    }
    const std::vector<float> pixels{4, 5, -6.5f, 1, 2, 3};
    CHECK(read(folder, little).pixels == pixels);
    CHECK(read(folder, big).pixels == pixels);
    CHECK_THROWS_AS(read(folder, little.substr(0, little.size() - 1)), InputError);
}

TEST_CASE("Radiance HDR is read, plain, in old runs and in new ones, whatever the order of axes") {
    const ScratchFolder folder;
    const std::string head = "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n";
    const std::string one = "\x80\x40\x20\x81"s, dark("\0\0\0\0", 4); // 1, 0.5, 0.25
    const std::vector<float> pixels{1, 0.5f, 0.25f, 0, 0, 0};
    CHECK(read(folder, head + "-Y 1 +X 2\n" + one + dark).pixels == pixels);
    CHECK(read(folder, head + "+Y 2 +X 1\n" + dark + one).pixels == pixels);
    CHECK(read(folder, head + "+X 2 -Y 1\n" + one + dark).pixels == pixels);
    const Image old_runs = read(folder, head + "-Y 1 +X 5\n" + one + "\1\1\1\4"s);
    for (size_t x = 0; x < 5; ++x) CHECK(old_runs.pixels[3 * x + 1] == 0.5f);
    std::string runs = "\2\2\0\x0a"s;
    for (const char c : one) runs += "\x88"s + c + "\2"s + c + c;
    const Image new_runs = read(folder, head + "-Y 1 +X 10\n" + runs);
    for (size_t x = 0; x < 10; ++x) CHECK(new_runs.pixels[3 * x + 2] == 0.25f);
    for (size_t cut = 0; cut < runs.size(); ++cut)
        CHECK_THROWS_AS(read(folder, head + "-Y 1 +X 10\n" + runs.substr(0, cut)), InputError);
    CHECK_THROWS_AS(read(folder, head + "-Y 1 +X 2\n\1\1\1\4"), InputError); // repeats nothing
}

TEST_CASE("KTX2 is read, plain and packed, in every order of channels") {
    const std::string rgba = text_of(RGBA), rgb = text_of(RGB);
    check_reads(ktx2_file(43, 0, rgba, 0), RGBA);
    check_reads(ktx2_file(37, 2, zstandard(rgba), rgba.size()), RGBA);
    check_reads(ktx2_file(29, 0, rgb, 0), opaque(RGB));
    std::string bgr = rgb;
    for (size_t i = 0; i < bgr.size(); i += 3) std::swap(bgr[i], bgr[i + 2]);
    check_reads(ktx2_file(30, 0, bgr, 0), opaque(RGB));
    check_reads(ktx2_file(9, 0, "\1\2\3\4\5\6", 0), {1, 0, 0, 255, 2, 0, 0, 255, 3, 0, 0, 255,
                                                     4, 0, 0, 255, 5, 0, 0, 255, 6, 0, 0, 255});
}

TEST_CASE("KTX2 whose numbers lie is refused") {
    const std::string rgba = text_of(RGBA);
    CHECK_THROWS_AS(decode(ktx2_file(37, 2, zstandard(rgba), rgba.size() + 1)), InputError);
    CHECK_THROWS_AS(decode(ktx2_file(37, 2, "not packed at all", rgba.size())), InputError);
    CHECK_THROWS_AS(decode(ktx2_file(37, 2, zstandard(rgba.substr(1)), rgba.size())), InputError);
    CHECK_THROWS_AS(decode(ktx2_file(37, 3, rgba, rgba.size())), InputError);
    CHECK_THROWS_AS(decode(ktx2_file(37, 0, rgba + "x", 0)), InputError);
    CHECK_THROWS_WITH(decode(ktx2_file(131, 0, rgba, 0)), Catch::Contains("131")); // BC1
    std::string far = ktx2_file(37, 0, rgba, 0);
    for (const size_t at : {80, 88}) { // where its level begins, how long it is
        std::string lying = far;
        lying.replace(at, 8, 8, '\xff');
        CHECK_THROWS_AS(decode(lying), InputError);
    }
}

TEST_CASE("Basis Universal is transcoded, or refused by a sentence that says what is missing") {
    const auto path = onde::test::find_asset("images/ktx2/test_etc1s.ktx2");
    if (!path) return;
    try {
        const TexelImage image = decode(onde::test::read_bytes(*path));
        CHECK(image.rgba.size() == 4 * size_t(image.width) * image.height);
    } catch (const InputError& error) {
        CHECK_THAT(error.what(), Catch::Contains("tools/basis/build.sh"));
    }
}

TEST_CASE("what is in no format that we name is refused, GIF too") {
    for (const std::string& file : {"GIF89a\xff\xff\xff\xff\0\0\0,"s, "P6 1 1 255 abc"s, "BM"s})
        CHECK_THROWS_AS(decode(file), InputError);
}
