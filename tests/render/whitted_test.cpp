// The Whitted integrator's engines are different ways to the same bits, and no ray is ever lost.
#include "chapter/whitted_scene.h"
#include "render/picture.h"
#include "render/variants.h"
#include "shared/whitted.h"
#include "support/folders.h"

namespace onde::test {
namespace {

/// The scene with a material that nothing is made of, for which kernels must know all that Whitted
/// kernels can know: scenes then share compiled programs. The other programs are tested by
/// whitted_reference_test.
Scene with_unused_dispersive_glass(Scene scene) {
    Material glass;
    glass.kind = MaterialKind::phong;
    scene.chapter.phong[uint32_t(scene.materials.size())] = {.transmission = 1.0f, .abbe = 30.0f};
    scene.materials.push_back(glass);
    const PackedWhitted packed = pack_whitted(scene, 1);
    REQUIRE((packed.translucent && packed.dispersive));
    return scene;
}

Scene mirrors_and_glass() {
    return with_unused_dispersive_glass(
        load_scene(std::filesystem::path(in_project("scenes/chapter/five-objects.toml"))));
}

RenderOptions whitted_options(const Scene& scene, uint32_t samples) {
    RenderOptions options = small_options(40, 28, samples);
    options.integrator = IntegratorKind::whitted;
    options.depth = std::min(scene.settings.depth.value_or(options.depth), uint32_t(12));
    return options;
}

} // namespace

TEST_CASE("every engine, width and launch makes the same ray trees of every scene") {
    for (const auto& path : project_scenes()) {
        const Scene scene = with_unused_dispersive_glass(load_scene(path));
        const DeviceScene placed = place_on_device(scene);
        const RenderOptions options = whitted_options(scene, 2);
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

TEST_CASE("a ray tree is the same in waves and chunks of any size") {
    const Scene scene = mirrors_and_glass();
    const DeviceScene placed = place_on_device(scene);
    RenderOptions options = whitted_options(scene, 4);
    const Picture expected = render_by(scene, placed, options);
    REQUIRE(expected.rays.extension.size() >= 6); // deep trees, or nothing is tested
    for (const auto launch : {gpu::Launch::fused, gpu::Launch::staged})
        for (const uint32_t wave_size : {256u, 4096u})
            for (const uint32_t chunk : {16u, 256u}) {
                INFO("waves of " << wave_size << ", " << chunk << " paths a work item");
                options.settings.launch = launch;
                options.settings.chunk = chunk;
                options.settings.wave_size = wave_size;
                const Picture picture = render_by(scene, placed, options);
                CHECK(first_difference(expected.image, picture.image) == "");
                CHECK(expected.rays.extension == picture.rays.extension);
                CHECK(expected.rays.shadow == picture.rays.shadow);
            }
}

TEST_CASE("a deeper tree than there is memory for levels is refused") {
    const Scene scene = mirrors_and_glass();
    RenderOptions options = whitted_options(scene, 1);
    options.depth = MAX_TREE_DEPTH + 1;
    CHECK_THROWS_WITH(render_scene(scene, options),
                      Catch::Contains("depth of --integrator whitted"));
}

} // namespace onde::test
