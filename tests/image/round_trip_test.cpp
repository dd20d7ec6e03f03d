// What is written is what is read.
#include "core/error.h"
#include "core/files.h"
#include "image/image_io.h"
#include "image/scratch.h"
#include "image/tone.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace onde;
using onde::test::ScratchFolder;

namespace {

/// Values over many magnitudes and both signs, every sample different.
Image ramp(uint32_t width, uint32_t height, uint32_t channels) {
    Image image(width, height, channels);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = std::ldexp(1.0f + float(i) / 1000, int(i % 20) - 10) * (i % 3 ? 1 : -1);
    return image;
}

void check_same(const Image& read, const Image& written) {
    REQUIRE(read.width == written.width);
    REQUIRE(read.height == written.height);
    REQUIRE(read.channels == written.channels);
    CHECK(read.pixels == written.pixels);
}

} // namespace

TEST_CASE("a 32-bit EXR gives back every float, for one, three and four channels") {
    const ScratchFolder folder;
    for (const uint32_t channels : {1u, 3u, 4u}) {
        const Image image = ramp(17, 9, channels);
        write_exr(folder / "a.exr", image, {}, ExrDepth::full_float);
        check_same(read_image(folder / "a.exr"), image);
    }
}

TEST_CASE("an EXR of many layers gives back each channel by its name, in its depth") {
    const ScratchFolder folder;
    const Image colours = ramp(7, 5, 3), numbers = ramp(7, 5, 2);
    const std::vector<ExrLayer> layers{{colours, {"R", "G", "B"}, ExrDepth::full_float},
                                       {numbers, {"uv.U", "uv.V"}, ExrDepth::full_float},
                                       {ramp(7, 5, 1), {"light.Y"}, ExrDepth::half_float}};
    write_exr(folder / "a.exr", layers, {{"onde:seed", "7"}});
    check_same(read_image(folder / "a.exr"), colours);
    check_same(read_exr(folder / "a.exr", {"uv.U", "uv.V"}), numbers);
    CHECK(read_exr(folder / "a.exr", {"uv.V", "R"}).pixels[1] == colours.pixels[0]);
    CHECK(read_image_metadata(folder / "a.exr").at("onde:seed") == "7");
    CHECK_THROWS_AS(read_exr(folder / "a.exr", {"uv.W"}), InputError);
    const std::vector<ExrLayer> twice{layers[0], layers[0]};
    CHECK_THROWS_AS(write_exr(folder / "b.exr", twice, {}), InputError);
    const std::vector<ExrLayer> sizes{layers[0], {ramp(6, 5, 1), {"Z"}}};
    CHECK_THROWS_AS(write_exr(folder / "b.exr", sizes, {}), InputError);
}

TEST_CASE("a 16-bit EXR is within half a unit in the last place of a half") {
    const ScratchFolder folder;
    const Image image = ramp(31, 11, 3);
    write_exr(folder / "a.exr", image, {});
    const Image read = read_image(folder / "a.exr");
    REQUIRE(read.pixels.size() == image.pixels.size());
    for (size_t i = 0; i < read.pixels.size(); ++i) {
        const float half_ulp = std::ldexp(1.0f, std::ilogb(image.pixels[i]) - 11);
        INFO("sample " << i << ": wrote " << image.pixels[i] << ", read " << read.pixels[i]);
        REQUIRE(std::abs(read.pixels[i] - image.pixels[i]) <= half_ulp);
    }
}

TEST_CASE("a 16-bit EXR clamps what a half cannot hold and keeps NaN") {
    const ScratchFolder folder;
    Image image(3, 1, 1);
    const float inf = std::numeric_limits<float>::infinity();
    image.pixels = {1e9f, -inf, std::numeric_limits<float>::quiet_NaN()};
    write_exr(folder / "a.exr", image, {});
    const Image read = read_image(folder / "a.exr");
    CHECK(read.pixels[0] == 65504.0f);
    CHECK(read.pixels[1] == -65504.0f);
    CHECK(std::isnan(read.pixels[2]));
}

TEST_CASE("text attributes come back from EXR and PNG headers") {
    const ScratchFolder folder;
    const ImageMetadata metadata{{"onde:seed", "7"}, {"onde:scene", "0123456789abcdef"}};
    const Image image = ramp(2, 2, 3);
    write_exr(folder / "a.exr", image, metadata);
    write_png(folder / "a.png", image, {}, metadata);
    for (const char* name : {"a.exr", "a.png"}) {
        INFO(name);
        ImageMetadata read = read_image_metadata(folder / name);
        CHECK(read["onde:seed"] == "7");
        CHECK(read["onde:scene"] == "0123456789abcdef");
    }
}

TEST_CASE("an 8-bit PNG is linearised when read and exact in its bytes") {
    const ScratchFolder folder;
    Image image(256, 1, 4);
    for (uint32_t x = 0; x < 256; ++x)
        for (uint32_t channel = 0; channel < 4; ++channel) {
            const float code = float(x) / 255;
            image.pixel(x, 0)[channel] = channel == 3 ? code : linear_from_srgb(code);
        }
    write_png(folder / "a.png", image, {}, {});
    const Image read = read_image(folder / "a.png");
    REQUIRE(read.channels == 4);
    for (size_t i = 0; i < read.pixels.size(); ++i) {
        INFO("sample " << i);
        REQUIRE(read.pixels[i] == Approx(image.pixels[i]).margin(1e-6));
    }
}

TEST_CASE("colour under zero alpha survives, for a texture may need it") {
    const ScratchFolder folder;
    Image image(1, 1, 4);
    image.pixels = {1, linear_from_srgb(0.6f), 0, 0};
    write_png(folder / "a.png", image, {}, {});
    const std::string file = read_file(folder / "a.png");
    const TexelImage texture =
        decode_texels({reinterpret_cast<const uint8_t*>(file.data()), file.size()}, "a.png");
    CHECK(texture.rgba == std::vector<uint8_t>{255, 153, 0, 0});
}

TEST_CASE("the content decides the format, not the name") {
    const ScratchFolder folder;
    const Image image = ramp(4, 4, 3);
    write_exr(folder / "picture.png", image, {}, ExrDepth::full_float);
    check_same(read_image(folder / "picture.png"), image);
}

TEST_CASE("a picture that cannot be written leaves nothing behind") {
    const ScratchFolder folder;
    const Image image = ramp(2, 2, 3);
    CHECK_THROWS_AS(write_exr(folder / "absent" / "a.exr", image, {}), InputError);
    CHECK_THROWS_AS(write_png(folder / "", image, {}, {}), InputError);
    CHECK_THROWS_AS(write_exr(folder / "a.exr", ramp(2, 2, 2), {}), InputError);
    CHECK_THROWS_AS(write_png(folder / "a.png", Image(0, 0, 3), {}, {}), InputError);
    CHECK(folder.is_empty());
}

TEST_CASE("a failed write keeps the picture that was there") {
    const ScratchFolder folder;
    const Image image = ramp(2, 2, 3);
    write_exr(folder / "a.exr", image, {}, ExrDepth::full_float);
    CHECK_THROWS_AS(write_exr(folder / "a.exr", Image(0, 0, 3), {}), InputError);
    check_same(read_image(folder / "a.exr"), image);
}
