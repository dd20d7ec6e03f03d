// Bilinear lookups against double precision, at every wrap mode and across the borders.
#include "doctor/exact.h"
#include "doctor/textured_scene.h"
#include "kernels/scene_probe.h"
#include "upload/textures.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;
using doctor::look_up;
using doctor::textured_scene;
using doctor::wrap_index;

namespace {

constexpr size_t COUNT = 1 << 14;
/// Against double precision.
void check_look_ups(const Scene& scene, uint32_t width = 1, double bound = 5e-6) {
    SceneProbe probe(scene, {"texture"}, width);
    Generator generator(52);
    for (uint32_t t = 0; t < scene.textures.size(); t++) {
        INFO("texture " << t);
        Columns in{word_column(COUNT, t), uniform_column(generator, COUNT, -2.5f, 3.5f),
                   uniform_column(generator, COUNT, -2.5f, 3.5f)};
        for (int i = -20; i <= 20; i++) { // borders and middles of texels
            in[1][size_t(i + 20)] = float(i) / 8;
            in[2][size_t(i + 60)] = float(i) / 8;
        }
        const Columns out = probe.run("texture", in, 7);
        for (size_t k = 0; k < 6; k++) {
            const auto wanted = [&](size_t i) {
                return look_up(scene.textures[t], in[1][i], in[2][i], k % 3, k >= 3);
            };
            CHECK(worst_difference(out[k], wanted, bound) == "");
        }
        const auto alpha = [&](size_t i) {
            return look_up(scene.textures[t], in[1][i], in[2][i], 3, false);
        };
        CHECK(worst_difference(out[6], alpha, bound) == "");
    }
}

} // namespace

TEST_CASE("textures are bilinear under every wrap mode, and colours linear before filtering") {
    check_look_ups(textured_scene());
}

TEST_CASE("samples of 16 bits keep them, beside textures of 8, at every width") {
    Scene scene = textured_scene();
    Generator generator(55);
    for (size_t t = 0; t < scene.textures.size(); t += 2) {
        TexelImage& image = scene.textures[t].image;
        for (size_t i = 0; i < image.rgba.size(); i++) image.low.push_back(uint8_t(generator()));
    }
    scene.textures[0].image.rgba[0] = scene.textures[0].image.low[1] = 0; // both ends of the table
    scene.textures[0].image.rgba[4] = scene.textures[0].image.low[5] = 255;
    for (const uint32_t width : {1u, 8u, 16u}) check_look_ups(scene, width, 1e-5);
}

TEST_CASE("textures of 8 bits read the same bits beside one of 16") {
    Scene scene = textured_scene();
    SceneProbe alone(scene, {"texture"});
    TexelImage& last = scene.textures.back().image;
    last.low.assign(last.rgba.size(), 7);
    SceneProbe beside(scene, {"texture"});
    Generator generator(56);
    for (uint32_t t = 0; t + 1 < scene.textures.size(); t++) {
        const Columns in{word_column(COUNT, t), uniform_column(generator, COUNT, -2, 3),
                         uniform_column(generator, COUNT, -2, 3)};
        CHECK(first_bit_difference(beside.run("texture", in, 7), alone.run("texture", in, 7)) ==
              "");
    }
}

TEST_CASE(
    "floats keep their range, as halves where those hold them, beside codes, at every width") {
    Scene scene = textured_scene();
    Generator generator(57);
    const auto set = [&](size_t t, auto sample) {
        TexelImage& image = scene.textures[t].image;
        image.floats.resize(image.rgba.size());
        for (size_t i = 0; i < image.floats.size(); i++)
            image.floats[i] = i % 4 == 3 ? 0.5f : sample();
        image.rgba.clear();
    };
    const auto below_four = [&] { return float(generator() % 2048) / 512; };
    for (const size_t t : {1, 5}) set(t, below_four);
    set(2, [&] { return below_four() + 1e-5f; });
    set(9, [] { return 1e6f; }); // one texel
    scene.textures[5].image.floats[1] = 0x1p-24f;
    for (size_t i = 0; i < scene.textures[4].image.rgba.size(); i++)
        scene.textures[4].image.low.push_back(uint8_t(generator()));
    const PackedTextures packed = pack_textures(scene);
    const auto format = [&](size_t t) { return packed.records[t].format; };
    CHECK(format(0) == TEXEL_BYTES);
    CHECK(format(1) == TEXEL_HALVES);
    CHECK(format(2) == TEXEL_FLOATS);
    CHECK(format(5) == TEXEL_HALVES);
    CHECK(format(9) == TEXEL_FLOATS);
    scene.textures[9].image.floats[0] = 2; // against which the bound is absolute
    for (const uint32_t width : {1u, 8u, 16u}) check_look_ups(scene, width, 2e-5);
}

TEST_CASE("texels lie in several buffers where one is too small, and are read as from one") {
    const Scene scene = textured_scene();
    SceneProbe one(scene, {"texture"});
    size_t most = 0; // what the largest picture takes
    for (const Texture& texture : scene.textures) most = std::max(most, texture.image.rgba.size());
    CHECK_THROWS_WITH(pack_textures(scene, {.largest_buffer = most / 2}),
                      Catch::Contains("--texture-memory"));
    const TextureOptions several{.largest_buffer = most + most / 4};
    size_t full = 0;
    for (const auto& texels : pack_textures(scene, several).texels) full += !texels.empty();
    REQUIRE(full == TEXEL_BUFFER_COUNT);
    Generator generator(58);
    for (const uint32_t width : {1u, 8u, 16u}) {
        SceneProbe split(scene, {"texture"}, width, {}, {}, several);
        for (uint32_t t = 0; t < scene.textures.size(); t++) {
            Columns in{word_column(COUNT, t), uniform_column(generator, COUNT, -2, 3),
                       uniform_column(generator, COUNT, -2, 3)};
            for (size_t i = 0; i < COUNT; i += 3) in[0][i] = word(uint32_t(i % 10)); // lanes differ
            CHECK(first_bit_difference(split.run("texture", in, 7), one.run("texture", in, 7)) ==
                  "");
        }
    }
}

TEST_CASE("the nearest texel is taken where the texture says so, under every wrap mode") {
    Scene scene = textured_scene();
    for (Texture& texture : scene.textures) texture.filter = TextureFilter::nearest;
    SceneProbe probe(scene, {"texture"});
    Generator generator(53);
    for (uint32_t t = 0; t < scene.textures.size(); t++) {
        INFO("texture " << t);
        const Texture& texture = scene.textures[t];
        Columns in{word_column(COUNT, t), uniform_column(generator, COUNT, -2.5f, 3.5f),
                   uniform_column(generator, COUNT, -2.5f, 3.5f)};
        in[1][0] = in[2][0] = 1.0f;
        const Columns out = probe.run("texture", in, 7);
        const auto at = [&](float x, uint32_t size, Wrap wrap) {
            return wrap_index(int64_t(std::floor(double(x) * size)), size, wrap);
        };
        size_t wrong = 0; // next to a texel's edge rounding decides
        for (size_t i = 0; i < COUNT; i++) {
            const TexelImage& image = texture.image;
            const size_t texel = at(in[2][i], image.height, texture.wrap_v) * image.width +
                                 at(in[1][i], image.width, texture.wrap_u);
            wrong += std::abs(out[0][i] - image.rgba[4 * texel] / 255.0f) > 1e-6f ||
                     std::abs(out[6][i] - image.rgba[4 * texel + 3] / 255.0f) > 1e-6f;
        }
        CHECK(wrong < COUNT / 1000);
    }
}

TEST_CASE("texture coordinates are scaled, turned and moved as their texture says") {
    Scene scene = textured_scene();
    const UvTransform transform{{0.3f, -0.2f}, 0.7f, {2.0f, -1.5f}};
    for (Texture& texture : scene.textures) texture.transform = transform;
    SceneProbe probe(scene, {"texture"});
    SceneProbe plain(textured_scene(), {"texture"});
    Generator generator(54);
    const Columns in{word_column(COUNT, 4), uniform_column(generator, COUNT, -1, 1),
                     uniform_column(generator, COUNT, -1, 1)};
    Columns moved = in;
    for (size_t i = 0; i < COUNT; i++) {
        const glm::vec2 uv = transform({in[1][i], in[2][i]});
        moved[1][i] = uv.x;
        moved[2][i] = uv.y;
    }
    const Columns out = probe.run("texture", in, 7), wanted = plain.run("texture", moved, 7);
    for (size_t k = 0; k < 7; k++)
        CHECK(worst_difference(
                  out[k], [&](size_t i) { return double(wanted[k][i]); }, 2e-5) == "");
}

TEST_CASE("lanes without a texture get ones, beside lanes that have one") {
    const Scene scene = textured_scene();
    Columns in(3, constant_column(COUNT, 0.3f));
    for (size_t i = 0; i < COUNT; i++) in[0][i] = word(i % 3 ? uint32_t(i % 10) : NO_INDEX);
    SceneProbe scalar(scene, {"texture"});
    const Columns one = scalar.run("texture", in, 7);
    for (size_t k = 0; k < 7; k++)
        for (size_t i = 0; i < COUNT; i += 3) REQUIRE(one[k][i] == 1.0f);
    for (uint32_t width : {8u, 16u}) {
        SceneProbe wide(scene, {"texture"}, width);
        CHECK(first_bit_difference(wide.run("texture", in, 7), one) == "");
    }
}

TEST_CASE("texture coordinates that are huge or not finite read some texel") {
    const float infinity = std::numeric_limits<float>::infinity();
    const Column wild{1e30f, -1e30f, infinity, -infinity, NAN, 1e10f, -3e9f};
    SceneProbe probe(textured_scene(), {"texture"});
    for (uint32_t t = 0; t < 10; t++) {
        const Columns out =
            probe.run("texture", {word_column(wild.size(), t), wild, Column(wild.size(), 0.5f)}, 7);
        for (size_t i = 0; i < wild.size(); i++) {
            INFO("texture " << t << " at " << wild[i] << " is " << out[0][i]);
            CHECK((std::isnan(out[0][i]) || (out[0][i] >= 0 && out[0][i] <= 1)));
        }
    }
}
