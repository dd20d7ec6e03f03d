// The device's pictures against the independent reference renderer, by a Z-test.
#include "render/picture.h"
#include "support/folders.h"
#include "support/reference/compare.h"

namespace onde::test {
namespace {

Comparison compare_both(const Scene& scene, uint32_t depth, uint32_t samples) {
    RenderOptions options = small_options(64, 48, samples);
    options.depth = depth;
    ReferenceOptions reference;
    reference.width = options.width;
    reference.height = options.height;
    reference.samples = samples;
    reference.depth = depth;
    reference.seed = 7;
    const Picture picture = render_scene(scene, options);
    REQUIRE(picture.invalid.count == 0);
    return compare_to_reference(picture.image, samples, ReferenceRenderer(scene).render(reference));
}

void check_file(const char* name, uint32_t samples = 256) {
    const Scene scene = load_scene(std::filesystem::path(in_project("scenes")) / name);
    const Comparison comparison = compare_both(scene, scene.settings.depth.value_or(8), samples);
    INFO(name << ": " << comparison.sentence);
    CHECK(comparison.accepted);
}

} // namespace

TEST_CASE("the Cornell box has the reference's expected value") {
    check_file("cornell.toml");
}
TEST_CASE("a row of spheres of all materials has the reference's expected value") {
    check_file("spheres.toml");
}
TEST_CASE("lights of all kinds have the reference's expected value") {
    check_file("lights.toml");
}
TEST_CASE("instances have the reference's expected value") {
    check_file("instances.toml");
}
TEST_CASE("the five objects have the reference's expected value") {
    check_file("chapter/five-objects.toml");
}

TEST_CASE("a textured, normal-mapped model under a picture of the sky has the reference's value") {
    const auto model = find_asset("gltf/DamagedHelmet/glTF-Binary/DamagedHelmet.glb");
    const auto sky = find_asset("hdr/chinese_garden_1k.hdr");
    if (!model || !sky) return;
    Scene scene = load_scene(*model);
    scene.environment = load_environment(*sky, glm::vec3(1), 40);
    const Comparison comparison = compare_both(scene, 6, 128);
    INFO(comparison.sentence);
    CHECK(comparison.accepted);
}

} // namespace onde::test
