#include "denoise/device_denoiser.h"

#include "denoise/pictures.h"
#include "denoise/plain_denoiser.h"
#include "support/programs.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace onde;
using namespace onde::test;

namespace {

Image denoised(const NoisyPicture& noisy, const DenoiserCut& cut) {
    return DeviceDenoiser(programs(), cut).denoise(noisy).radiance;
}
Image denoised(const NoisyPicture& noisy) {
    return denoised(noisy, denoiser_cut(device().facts(), noisy.radiance.width));
}

constexpr DenoiserCut CUTS[] = {
    {.width = 1, .columns = 4, .rows = 4},
    {.width = 8, .columns = 16, .rows = 8, .band_rows = 16},
    {.width = 16, .columns = 32, .rows = 16},
    {.width = 1, .columns = 32, .rows = 2, .group = 8, .band_rows = 32}};

DenoiserCut with_passes(DenoiserCut cut, uint32_t passes) {
    cut.passes = passes;
    return cut;
}

/// Slopes, edges of everything, outliers and a black corner.
NoisyPicture varied_picture(uint32_t width, uint32_t height) {
    NoisyPicture picture = noisy_picture(width, height, [](uint32_t x, uint32_t y, size_t channel) {
        return x < 6 && y < 6 ? 0.0f
                              : 0.2f + 0.02f * float(x) + (y > 20 ? 0.3f * float(channel) : 0);
    });
    Numbers numbers;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            picture.albedo.pixel(x, y)[0] = x > width / 2 ? 0.7f : 0.3f + 0.02f * numbers.next();
            picture.normal.pixel(x, y)[0] = 0.01f * float(y);
            picture.depth.pixel(x, y)[0] = y > 25 ? 3.0f : 5.0f + 0.05f * float(x);
            if (numbers.next() < 0.02f) picture.radiance.pixel(x, y)[1] += 20.0f;
            if (numbers.next() < 0.02f) picture.variance.pixel(x, y)[1] += 4.0f;
        }
    return picture;
}

} // namespace

TEST_CASE("one pass of the denoiser is what its definition says, at every width") {
    const NoisyPicture noisy = varied_picture(45, 35);
    const PlainDenoiser plain(noisy);
    const int rows[] = {0, 1, 7, 16, 20, 33, 34},
              columns[] = {0, 2, 15, 16, 22, 23, 31, 32, 43, 44};
    std::vector<Image> pictures;
    for (const DenoiserCut& cut : CUTS) pictures.push_back(denoised(noisy, with_passes(cut, 1)));
    for (int y : rows)
        for (int x : columns) {
            const std::array<double, 3> wanted = plain.pixel(x, y);
            for (size_t i = 0; i < 3 * pictures.size(); ++i) {
                CAPTURE(x, y, i);
                CHECK(double(pictures[i / 3].pixel(uint32_t(x), uint32_t(y))[i % 3]) ==
                      Approx(wanted[i % 3]).epsilon(2e-4).margin(1e-6));
            }
        }
}

TEST_CASE("denoised pictures have the same bits at every width, in tiles and bands of any size") {
    const NoisyPicture noisy = varied_picture(71, 53);
    const Image first = denoised(noisy, CUTS[0]);
    for (const DenoiserCut& cut : CUTS) {
        CAPTURE(cut.width, cut.columns, cut.rows, cut.band_rows);
        CHECK(denoised(noisy, cut).pixels == first.pixels);
    }
}

TEST_CASE("a second pass takes noise that the first one left") {
    const NoisyPicture noisy = noisy_picture(64, 64, [](auto...) { return 0.5f; });
    const auto error = [&](uint32_t passes) {
        const Image image = denoised(noisy, with_passes(CUTS[0], passes));
        double sum = 0;
        for (float value : image.pixels) sum += std::pow(double(value) - 0.5, 2);
        return sum;
    };
    CHECK(error(2) < 0.9 * error(1));
}

TEST_CASE("a picture without noise stays as it is") {
    NoisyPicture noisy = varied_picture(40, 30);
    for (float& variance : noisy.variance.pixels) variance = 0;
    const Image picture = denoised(noisy);
    for (size_t i = 0; i < picture.pixels.size(); ++i)
        REQUIRE(picture.pixels[i] == Approx(noisy.radiance.pixels[i]).epsilon(1e-5));
}

TEST_CASE("of noise on a plain surface, most goes and the mean stays") {
    const NoisyPicture noisy = noisy_picture(64, 64, [](auto...) { return 0.5f; });
    const Image picture = denoised(noisy);
    CHECK(mean_of(picture, 0, 64) == Approx(mean_of(noisy.radiance, 0, 64)).epsilon(0.02));
    const auto error = [](const Image& image) {
        double sum = 0;
        for (float value : image.pixels) sum += (value - 0.5) * (value - 0.5);
        return sum / double(image.pixels.size());
    };
    CHECK(error(picture) < 0.04 * error(noisy.radiance));
}

TEST_CASE("nothing crosses an edge of albedo") {
    const auto light = [](uint32_t x, uint32_t, size_t) { return x < 32 ? 0.1f : 0.8f; };
    NoisyPicture noisy = noisy_picture(64, 64, light);
    for (uint32_t y = 0; y < 64; ++y)
        for (uint32_t x = 0; x < 64; ++x)
            for (size_t k = 0; k < 3; ++k) noisy.albedo.pixel(x, y)[k] = light(x, y, k);
    const Image picture = denoised(noisy);
    for (uint32_t away : {1u, 2u, 4u}) {
        CAPTURE(away);
        CHECK(mean_of(picture, 32 - away, 32) ==
              Approx(mean_of(noisy.radiance, 24, 32)).epsilon(0.06));
        CHECK(mean_of(picture, 32, 32 + away) ==
              Approx(mean_of(noisy.radiance, 32, 40)).epsilon(0.06));
    }
}

TEST_CASE("an outlier neither stays nor spreads, and a light that is sure stays") {
    NoisyPicture noisy = noisy_picture(41, 41, [](auto...) { return 0.5f; });
    const Image before = denoised(noisy);
    for (size_t k = 0; k < 3; ++k) noisy.radiance.pixel(20, 20)[k] = 1000;
    SECTION("of one sample in 16") {
        for (size_t k = 0; k < 3; ++k) noisy.variance.pixel(20, 20)[k] = 1e6f;
        const Image after = denoised(noisy);
        for (size_t i = 0; i < after.pixels.size(); ++i)
            REQUIRE(after.pixels[i] == Approx(before.pixels[i]).epsilon(0.25));
    }
    SECTION("that every sample has seen") {
        for (size_t k = 0; k < 3; ++k) noisy.variance.pixel(20, 20)[k] = 1e-4f;
        CHECK(denoised(noisy).pixel(20, 20)[1] == Approx(1000).epsilon(1e-3));
    }
}

TEST_CASE("parts that are denoised with a picture add up to it") {
    NoisyPicture noisy = varied_picture(40, 30);
    noisy.parts.assign(3, Image(40, 30, 3));
    Numbers numbers;
    for (size_t i = 0; i < noisy.radiance.pixels.size(); ++i) {
        const float third = noisy.radiance.pixels[i] * numbers.next();
        noisy.parts[1].pixels[i] = third;
        noisy.parts[2].pixels[i] = noisy.radiance.pixels[i] - third;
    }
    const DenoisedPicture picture =
        DeviceDenoiser(programs(), denoiser_cut(device().facts(), 40)).denoise(noisy);
    REQUIRE(picture.parts.size() == 3);
    for (size_t i = 0; i < picture.radiance.pixels.size(); ++i) {
        REQUIRE(picture.parts[0].pixels[i] == 0.0f);
        REQUIRE(picture.parts[1].pixels[i] + picture.parts[2].pixels[i] ==
                Approx(picture.radiance.pixels[i]).epsilon(1e-5));
    }
}

TEST_CASE("pictures of any size and any numbers are denoised to finite ones") {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 50u}, {50u, 1u}, {3u, 2u}}) {
        CAPTURE(width, height);
        const Image picture = denoised(noisy_picture(width, height, [](auto...) { return 1.0f; }));
        CHECK(picture.width == width);
        for (float value : picture.pixels) CHECK((value > 0.0f && value < 4.0f));
    }
    NoisyPicture extreme = varied_picture(20, 20);
    extreme.radiance.pixel(5, 5)[0] = 3e38f;
    extreme.variance.pixel(6, 5)[0] = INFINITY;
    extreme.depth.pixel(7, 5)[0] = 1e30f;
    extreme.albedo.pixel(8, 5)[0] = NAN;
    for (float value : denoised(extreme).pixels) REQUIRE(std::isfinite(value));
}

TEST_CASE("a denoiser that is told to stop stops between bands") {
    const NoisyPicture noisy = noisy_picture(8, 64, [](auto...) { return 1.0f; });
    DeviceDenoiser denoiser(programs(), CUTS[1]);
    int bands = 0;
    const Image picture = denoiser.denoise(noisy, [&] { return ++bands < 3; }).radiance;
    CHECK(picture.pixel(0, 31)[0] > 0.0f);
    CHECK(picture.pixel(0, 31)[0] != noisy.radiance.pixel(0, 31)[0]);
    CHECK(picture.pixel(0, 32)[0] == noisy.radiance.pixel(0, 32)[0]);
}
