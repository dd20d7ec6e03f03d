// The engines, widths, launches and splits are different ways to the same bits.
#include "render/picture.h"
#include "render/variants.h"
#include "support/folders.h"

namespace onde::test {
namespace {

Scene five_objects() {
    return load_scene(std::filesystem::path(in_project("scenes/chapter/five-objects.toml")));
}

} // namespace

TEST_CASE("every engine, width and launch renders every scene with the same bits") {
    for (const auto& path : project_scenes()) {
        const Scene scene = load_scene(path);
        const DeviceScene placed = place_on_device(scene);
        RenderOptions options = small_options(40, 28, 3);
        options.depth = scene.settings.depth.value_or(options.depth);
        const Picture expected = render_by(scene, placed, apply(options, VARIANTS[0]));
        for (const Variant& variant : VARIANTS) {
            INFO(path.filename().string() << ", " << variant.name);
            const Picture picture = render_by(scene, placed, apply(options, variant));
            CHECK(first_difference(expected.image, picture.image) == "");
            CHECK(expected.rays.extension == picture.rays.extension);
            CHECK(expected.rays.shadow == picture.rays.shadow);
            CHECK(picture.invalid.count == 0);
        }
    }
}

TEST_CASE("the picture does not depend on the wave size, the chunk or the samples in flight") {
    const Scene scene = five_objects();
    const DeviceScene placed = place_on_device(scene);
    RenderOptions options = small_options(40, 28, 8);
    const Image expected = render_by(scene, placed, options).image;
    const auto check = [&](uint32_t wave_size, uint32_t chunk, uint32_t samples_in_flight) {
        options.settings.wave_size = wave_size;
        options.settings.chunk = chunk;
        options.samples_in_flight = samples_in_flight;
        INFO("waves of " << wave_size << ", chunks of " << chunk << ", " << samples_in_flight
                         << " samples in flight");
        CHECK(first_difference(expected, render_by(scene, placed, options).image) == "");
    };
    check(65536, 256, 1);
    check(65536, 256, 8);
    check(512, 64, 4);
    check(64, 16, 2);
    options.settings.launch = gpu::Launch::staged;
    check(4096, 16, 8);
    check(256, 16, 4);
}

TEST_CASE("kernels compiled for what a scene uses render the same bits as kernels that can all") {
    const Scene scene = five_objects();
    const RenderOptions options = small_options(40, 28, 2);
    const DeviceScene lean(device(), pack_scene(scene));
    const Image expected = render_scene(scene, options).image;
    CHECK(first_difference(expected, render_by(scene, lean, options).image) == "");
}

TEST_CASE("the seed changes the picture, the same seed does not") {
    const Scene scene = five_objects();
    const DeviceScene placed = place_on_device(scene);
    RenderOptions options = small_options(24, 16, 2);
    const Image first = render_by(scene, placed, options).image;
    CHECK(first_difference(first, render_by(scene, placed, options).image) == "");
    options.seed = 1;
    CHECK(first_difference(first, render_by(scene, placed, options).image) != "");
}

} // namespace onde::test
