#include "denoise/open_image_denoise.h"

#include "core/error.h"
#include "denoise/find_oidn.h"
#include "denoise/pictures.h"
#include "gpu/temporary_folder.h"

#include <catch2/catch.hpp>

#include <optional>

using namespace onde;
using namespace onde::test;

namespace {

constexpr uint64_t MEMORY = uint64_t(1) << 30;

/// The library, or nothing (with a warning in the test's output) where there is none.
std::optional<OpenImageDenoise> find_library() {
    if (const char* place = std::getenv(OIDN_VARIABLE); place && *place)
        return OpenImageDenoise(named_oidn(place, OIDN_VARIABLE));
    if (const auto library = installed_oidn()) return OpenImageDenoise(*library);
    WARN("skipped: no Open Image Denoise (install Python's pyoidn, or set " << OIDN_VARIABLE
                                                                            << ")");
    return std::nullopt;
}

NoisyPicture grey_picture() {
    return noisy_picture(128, 96, [](auto...) { return 0.5f; });
}

} // namespace

TEST_CASE("what is no Open Image Denoise is refused with one sentence") {
    const TemporaryFolder folder;
    folder.write("text.so", "no library at all");
    CHECK_THROWS_WITH(OpenImageDenoise(folder.path() / "text.so"),
                      Catch::Contains("text.so") && Catch::Contains("can't be opened"));
    CHECK_THROWS_WITH(OpenImageDenoise(folder.path() / "none.so"),
                      Catch::Contains("can't be opened"));
    CHECK_THROWS_WITH(OpenImageDenoise(ONDE_FOREIGN_LIBRARY),
                      Catch::Contains("has no oidnNewDevice"));
    CHECK_THROWS_WITH(OpenImageDenoise(ONDE_FAILING_LIBRARY),
                      Catch::Contains("this processor is too old"));
}

TEST_CASE("Open Image Denoise takes noise away and keeps the mean") {
    const auto library = find_library();
    if (!library) return;
    CHECK_THAT(library->name(), Catch::StartsWith("Open Image Denoise 2."));
    const NoisyPicture noisy = grey_picture();
    for (bool prefiltered : {false, true}) {
        CAPTURE(prefiltered);
        const Image picture = library->denoise(noisy, prefiltered, MEMORY).radiance;
        CHECK(mean_of(picture, 0, 128) == Approx(0.5).epsilon(0.05));
        double error = 0;
        for (float value : picture.pixels) error += std::pow(double(value) - 0.5, 2);
        CHECK(error / double(picture.pixels.size()) < 0.0005); // 0.0156 before
    }
}

TEST_CASE("parts that Open Image Denoise has denoised add up to the picture") {
    const auto library = find_library();
    if (!library) return;
    NoisyPicture noisy = grey_picture();
    noisy.parts.assign(3, Image(128, 96, 3));
    for (size_t i = 0; i < noisy.radiance.pixels.size(); ++i) {
        noisy.parts[1].pixels[i] = 0.25f * noisy.radiance.pixels[i];
        noisy.parts[2].pixels[i] = 0.75f * noisy.radiance.pixels[i];
    }
    const DenoisedPicture picture = library->denoise(noisy, false, MEMORY);
    for (size_t i = 0; i < picture.radiance.pixels.size(); ++i) {
        float sum = 0;
        for (const Image& part : picture.parts) sum += part.pixels[i];
        REQUIRE(sum == Approx(picture.radiance.pixels[i]).epsilon(1e-5));
    }
    CHECK(mean_of(picture.parts[1], 0, 128) == Approx(0.125).epsilon(0.1));
}

TEST_CASE("Open Image Denoise makes the same of a picture within little memory, nearly") {
    const auto library = find_library();
    if (!library) return;
    const NoisyPicture noisy = noisy_picture(600, 400, [](auto...) { return 0.5f; });
    const Image whole = library->denoise(noisy, false, MEMORY).radiance;
    const Image tiles = library->denoise(noisy, false, uint64_t(60) << 20).radiance;
    for (size_t i = 0; i < whole.pixels.size(); ++i)
        REQUIRE(tiles.pixels[i] == Approx(whole.pixels[i]).margin(0.02));
}
