// The Z-test accepts what it should and has the power to reject the rest.
#include "core/error.h"
#include "support/reference/compare.h"
#include "support/reference/scenes.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::reference;

namespace {

constexpr uint32_t DEVICE_SAMPLES = 32;

ReferenceResult render(uint32_t seed, uint32_t samples) {
    ReferenceOptions options;
    options.width = options.height = 96;
    options.samples = samples;
    options.depth = 6;
    options.seed = seed;
    return ReferenceRenderer(box_room(glass(1.5f, 0.0f))).render(options);
}

Image device_image(uint32_t seed) {
    const ReferenceResult result = render(seed, DEVICE_SAMPLES);
    Image image(result.width, result.height, 3);
    for (size_t i = 0; i < result.mean.size(); ++i)
        for (size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = result.mean[i][c];
    return image;
}

} // namespace

TEST_CASE("renders that differ by the seed alone are accepted") {
    const ReferenceResult reference = render(0, 64);
    for (const uint32_t seed : {1u, 2u, 3u, 4u, 5u}) {
        const Comparison c = compare_to_reference(device_image(seed), DEVICE_SAMPLES, reference);
        INFO(c.sentence);
        CHECK(c.accepted);
    }
}

TEST_CASE("a picture three percent too bright is rejected") {
    Image image = device_image(1);
    for (float& value : image.pixels) value *= 1.03f;
    const Comparison c = compare_to_reference(image, DEVICE_SAMPLES, render(0, 64));
    INFO(c.sentence);
    CHECK_FALSE(c.accepted);
    CHECK(c.mean_z > 4.0);
}

TEST_CASE("a picture upside down or with a wrong corner is rejected") {
    const ReferenceResult reference = render(0, 64);
    const Image image = device_image(1);
    Image flipped = image, patched = image;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x)
            for (uint32_t c = 0; c < 3; ++c) {
                flipped.pixel(x, y)[c] = image.pixel(x, image.height - 1 - y)[c];
                if (x < 24 && y < 24) patched.pixel(x, y)[c] *= 1.5f;
            }
    CHECK_FALSE(compare_to_reference(flipped, DEVICE_SAMPLES, reference).accepted);
    CHECK_FALSE(compare_to_reference(patched, DEVICE_SAMPLES, reference).accepted);
}

TEST_CASE("a single NaN is rejected and the sentence names its block") {
    Image image = device_image(1);
    image.pixel(50, 20)[1] = std::nanf("");
    const Comparison c = compare_to_reference(image, DEVICE_SAMPLES, render(0, 64));
    CHECK_FALSE(c.accepted);
    CHECK_THAT(c.sentence, Catch::Contains("(48, 16)"));
}

TEST_CASE("pictures of other sizes are refused in one sentence") {
    CHECK_THROWS_AS(compare_to_reference(Image(4, 4, 3), 1, render(0, 2)), InputError);
}
