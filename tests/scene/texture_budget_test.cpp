// Pictures of fewer texels: their means, and which ones are lowered.
#include "scene/texture_budget.h"

#include "image/lowered.h"
#include "image/texel_format.h"
#include "image/tone.h"
#include "scratch.h"

#include <random>

using namespace onde;
using onde::test::has_note;

namespace {

enum class Kind { bytes, wide, halves, floats };

TexelImage random_picture(uint32_t width, uint32_t height, Kind kind, uint32_t seed) {
    std::mt19937 generator(seed);
    TexelImage image;
    image.width = width;
    image.height = height;
    for (size_t i = 0; i < size_t(4) * width * height; i++) {
        const auto word = uint32_t(generator());
        if (kind == Kind::bytes || kind == Kind::wide) image.rgba.push_back(uint8_t(word));
        if (kind == Kind::wide) image.low.push_back(uint8_t(word >> 8));
        const float half = float(word % 2048) / 256;
        if (kind == Kind::halves) image.floats.push_back(i % 4 == 3 ? 0.5f : half);
        if (kind == Kind::floats) image.floats.push_back(i % 4 == 3 ? 0.5f : half + 1e-5f);
    }
    return image;
}

double mean_of(const TexelImage& image, size_t channel, bool srgb) {
    double sum = 0;
    for (size_t i = channel; i < image.samples(); i += 4)
        sum += double(linear_sample(image, i, srgb && channel < 3));
    return 4 * sum / double(image.samples());
}

Scene scene_of(std::initializer_list<uint32_t> sides) {
    Scene scene;
    for (const uint32_t side : sides) {
        Texture texture;
        texture.image = random_picture(side, side, Kind::bytes, side);
        scene.textures.push_back(texture);
    }
    return scene;
}

std::vector<uint32_t> sides_of(const Scene& scene) {
    std::vector<uint32_t> sides;
    for (const Texture& texture : scene.textures) sides.push_back(texture.image.width);
    return sides;
}

} // namespace

TEST_CASE("a lowered picture has the mean of the full one, in every format and odd sizes") {
    for (const Kind kind : {Kind::bytes, Kind::wide, Kind::halves, Kind::floats})
        for (const bool srgb : {false, true}) {
            const TexelImage full = random_picture(75, 34, kind, 3);
            const TexelImage low = lowered(full, 19, 9, srgb);
            CHECK(low.width == 19);
            CHECK(low.height == 9);
            CHECK(low.samples() == size_t(4) * 19 * 9);
            CHECK(texel_format(low) == texel_format(full));
            CHECK(low.low.empty() == full.low.empty());
            const double bound =
                kind == Kind::bytes ? 5e-4 : 2e-4; // of roundings that go both ways
            for (size_t channel = 0; channel < 4; channel++)
                CHECK(mean_of(low, channel, srgb) ==
                      Approx(mean_of(full, channel, srgb)).margin(bound));
        }
}

TEST_CASE("texels of a lowered picture are the means of those that they cover") {
    TexelImage full{3, 1, {0, 0, 0, 255, 90, 90, 90, 255, 240, 240, 240, 255}};
    CHECK(lowered(full, 2, 1, false).rgba == std::vector<uint8_t>{30, 30, 30, 255, // 2/3 and 1/3
                                                                  190, 190, 190, 255});
    full = {2, 1, {0, 0, 0, 0, 255, 255, 255, 255}};
    CHECK(lowered(full, 1, 1, true).rgba == std::vector<uint8_t>{188, 188, 188, 128});
}

TEST_CASE("the largest textures are halved first, until all fit") {
    Scene scene = scene_of({256, 64, 512, 128});
    constexpr uint64_t TEXEL = 4, ALL = TEXEL * (256 * 256 + 64 * 64 + 512 * 512 + 128 * 128);
    lower_textures(scene, ALL);
    CHECK(sides_of(scene) == std::vector<uint32_t>{256, 64, 512, 128});
    CHECK(scene.notes.empty());
    lower_textures(scene, ALL - 1);
    CHECK(sides_of(scene) == std::vector<uint32_t>{256, 64, 256, 128});
    CHECK(has_note(scene, "1 of 4 pictures have fewer texels now"));
    lower_textures(scene, TEXEL * 4 * 128 * 128);
    CHECK(sides_of(scene) == std::vector<uint32_t>{128, 64, 128, 128});
}

TEST_CASE("no texture is lowered below 64 texels, and a note says what that takes") {
    Scene scene = scene_of({256, 32});
    lower_textures(scene, 1000);
    CHECK(sides_of(scene) == std::vector<uint32_t>{64, 32});
    CHECK(has_note(scene, "none is made smaller than 64 x 64"));
}

TEST_CASE("textures that share a picture are lowered together") {
    Scene scene = scene_of({256});
    Texture other;
    other.same_image_as = 0;
    other.srgb = false;
    scene.textures.push_back(other);
    lower_textures(scene, 4 * 128 * 128);
    CHECK(image_of(scene.textures, scene.textures[1]).width == 128);
    CHECK(scene.textures[1].image.empty());
}
