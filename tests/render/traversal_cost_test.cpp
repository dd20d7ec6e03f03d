// What --aov traversal-cost counts, and that plain trees change costs and no pixel.
#include "chapter/hierarchy.h"
#include "kernels/scene_probe.h"
#include "render/picture.h"
#include "render/traversal_cost.h"
#include "render/variants.h"
#include "support/folders.h"

namespace onde::test {
namespace {

Scene scene_file(const std::string& name) {
    return load_scene(std::filesystem::path(in_project("scenes")) / name);
}

TraversalCost map_of(const Scene& scene, const BvhOptions& bvh, const RenderOptions& options) {
    const DeviceScene placed(device(), pack_scene(scene, bvh));
    return measure_traversal_cost({programs(), &scene, placed, scene.cameras[0], options, nullptr});
}

/// The rays of sample 0, as kernels make them.
std::vector<VolumeRay> camera_rays(const Scene& scene, const RenderOptions& options) {
    Column pixels;
    for (uint32_t y = 0; y < options.height; ++y)
        for (uint32_t x = 0; x < options.width; ++x) pixels.push_back(word(x | y << 16));
    const Columns in{pixels, word_column(pixels.size(), 0)};
    const Columns out = SceneProbe(scene, {"camera"}, 1, options).run("camera", in, 6);
    std::vector<VolumeRay> rays;
    for (size_t i = 0; i < pixels.size(); ++i)
        rays.push_back({glm::vec3(vector_at(out, 0, i)), glm::vec3(vector_at(out, 3, i))});
    return rays;
}

} // namespace

TEST_CASE("without a tree each camera ray tests every primitive, and the map's sum says so") {
    const Scene scene = scene_file("cornell.toml");
    const TraversalCost map =
        map_of(scene, {.builder = BvhBuilder::none}, small_options(32, 24, 1));
    const PackedScene packed = pack_scene(scene);
    const uint64_t primitives = packed.bvh.statistics.triangles + packed.bvh.statistics.spheres;
    uint64_t sum = 0;
    for (size_t i = 0; i < map.primitives.size(); ++i) {
        REQUIRE(map.primitives[i] == primitives);
        sum += map.at(i);
    }
    CHECK(map.sum() == sum);
    CHECK(map.largest() >= primitives);
}

TEST_CASE("the sum of the map is the number of tests that the same rays take in the laboratory") {
    Scene scene = scene_file("cornell.toml");
    scene.spheres.clear();                            // the laboratory takes triangles alone
    const TriangleSoup soup = scene_triangles(scene); // in the order in which a render has them
    RenderOptions options = small_options(64, 48, 1);
    options.filter = Filter::blackman_harris;
    const std::vector<VolumeRay> rays = camera_rays(scene, options);
    for (BvhBuilder builder :
         {BvhBuilder::sah, BvhBuilder::high, BvhBuilder::median, BvhBuilder::median_spatial}) {
        const TraversalCost map = map_of(scene, {.builder = builder}, options);
        const HierarchyReport counted = measure_hierarchy(programs(), soup, builder, rays);
        INFO("builder " << int(builder));
        CHECK(map.sum() == counted.boxes + counted.triangles);
        CHECK(counted.hits > 0);
    }
}

TEST_CASE("the pictures of a map hold its counts, and its largest is white") {
    const TraversalCost map{2, 1, {3, 0}, {4, 0}};
    CHECK(cost_numbers(map).pixels == std::vector<float>{3, 4, 7, 0, 0, 0});
    CHECK(heat_picture(map).pixels == std::vector<float>{1, 1, 1, 0, 0, 0});
}

TEST_CASE("plain trees render the same picture as the production tree") {
    for (const char* name : {"chapter/five-objects.toml", "instances.toml", "cornell.toml"}) {
        const Scene scene = scene_file(name);
        for (IntegratorKind integrator : {IntegratorKind::path, IntegratorKind::whitted}) {
            RenderOptions options = small_options(40, 28, 2);
            options.integrator = integrator;
            const Image expected = render_scene(scene, options).image;
            for (BvhBuilder builder : {BvhBuilder::high, BvhBuilder::median,
                                       BvhBuilder::median_spatial, BvhBuilder::none}) {
                PackedScene packed = pack_scene(scene, {.builder = builder});
                packed.features = all_features();
                packed.features.stack_size =
                    std::max(packed.features.stack_size, packed.bvh.stack_size);
                const DeviceScene placed(device(), std::move(packed));
                INFO(name << ", integrator " << int(integrator) << ", builder " << int(builder));
                CHECK(first_difference(expected, render_by(scene, placed, options).image) == "");
            }
        }
    }
}

TEST_CASE("the watertight option renders the same picture but for rounding") {
    const Scene scene = scene_file("chapter/five-objects.toml");
    const RenderOptions options = small_options(64, 48, 4);
    const Image expected = render_scene(scene, options).image;
    PackedScene packed = pack_scene(scene, {.watertight = true});
    packed.features = all_features();
    packed.features.watertight = true;
    const DeviceScene placed(device(), std::move(packed));
    const Image image = render_by(scene, placed, options).image;
    double difference = 0, sum = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        difference += std::abs(double(image.pixels[i]) - double(expected.pixels[i]));
        sum += double(expected.pixels[i]);
    }
    CHECK(sum > 0);
    CHECK(difference < 0.01 * sum);
}

} // namespace onde::test
