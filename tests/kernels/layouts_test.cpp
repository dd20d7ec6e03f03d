// The layouts for GPUs give the hits of the wide one, on any tree and any ray.
#include "kernels/traversal_checks.h"
#include "kernels/traversal_worlds.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::traversal;

namespace {

constexpr BvhLayout NARROW[] = {BvhLayout::compressed, BvhLayout::binary};

/// The world with a tree that is shaped for a layout, valid, and moved into it.
World in_layout(World world, BvhOptions options) {
    world.bvh = build_bvh(world.geometries, world.placements, options);
    INFO("layout " << int(options.layout) << ", builder " << int(options.builder) << ", "
                   << world.placements.size() << " placements, watertight " << options.watertight);
    REQUIRE(validate_bvh(world.bvh, world.geometries, world.placements) == "");
    compact_bvh(world.bvh, options.layout);
    return world;
}

} // namespace

TEST_CASE("every builder's tree gives the same hits in every layout, watertight or not") {
    const std::vector<Ray> rays = varied_rays(128);
    for (const World& world : {World(bumpy_terrain(60)), mixed_world(), needles(), grove()})
        for (const bool watertight : {false, true}) {
            const std::vector<std::string> defines{fmt::format("ONDE_WATERTIGHT={:d}", watertight)};
            const World as_wide = in_layout(world, {.watertight = watertight});
            Tracer wide(as_wide, defines, Abilities::all);
            const std::vector<Hit> expected = wide.closest(rays);
            const std::vector<uint32_t> blocked = wide.occluded(rays);
            for (const BvhLayout layout : NARROW)
                for (const BvhBuilder builder :
                     {BvhBuilder::sah, BvhBuilder::high, BvhBuilder::median}) {
                    const World narrow = in_layout(
                        world, {.builder = builder, .layout = layout, .watertight = watertight});
                    Tracer tracer(narrow, defines, Abilities::all);
                    INFO("layout " << int(layout) << ", builder " << int(builder) << ", watertight "
                                   << watertight);
                    CHECK(unlike(tracer.closest(rays), expected) == 0);
                    CHECK(differences(tracer.occluded(rays), blocked) == 0);
                }
        }
}

TEST_CASE("small trees in every layout answer like brute force, empty ones not at all") {
    for (const BvhLayout layout : NARROW) {
        for (const World& world :
             {World(random_triangles(2, 1.0f, 6)), World(random_spheres(1, 1.0f, 8)),
              World(random_triangles(9, 0.7f, 9)), World(random_spheres(20, 0.3f, 3))})
            check_against_brute_force(in_layout(world, {.layout = layout}), random_rays(5000, 7),
                                      Abilities::all);
        const World nothing = in_layout(World(Soup{}), {.layout = layout});
        Tracer empty(nothing, {}, Abilities::all);
        CHECK(std::ranges::none_of(empty.closest(random_rays(100, 20)), is_hit));
    }
}

TEST_CASE("rays with NaN or infinity, parallel to an axis or from afar, in every layout") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const BvhLayout layout : NARROW) {
        const World terrain = in_layout(World(bumpy_terrain(50)), {.layout = layout});
        Tracer bumpy(terrain, {}, Abilities::all);
        std::vector<Ray> bad, down, far;
        for (const float value : {nan, INFINITY, -INFINITY})
            for (int place = 0; place < 6; ++place) {
                Ray ray = {{0, 3, 0}, 0.0f, {0, -1, 0}, 1e30f};
                (place < 3 ? ray.origin : ray.direction)[glm::length_t(place % 3)] = value;
                bad.push_back(ray);
            }
        Generator generator(21);
        for (int i = 0; i < 2000; ++i) {
            const glm::vec3 target(uniform(generator, -0.9f, 0.9f), 0,
                                   uniform(generator, -0.9f, 0.9f));
            down.push_back({target + glm::vec3(0, 3, 0), 0.0f, {0.0f, -1, -0.0f}, 1e30f});
            const glm::vec3 origin = target + glm::vec3(2.4f, 40, -1.6f);
            far.push_back({origin, 0.0f, target - origin, 1e30f});
        }
        CHECK(std::ranges::none_of(bumpy.closest(bad), is_hit));
        CHECK(std::ranges::all_of(bumpy.closest(down), is_hit));
        CHECK(std::ranges::count_if(bumpy.closest(far), is_hit) >= 1999);
        CHECK(std::ranges::count(bumpy.occluded(bad), 1u) == 0);
        CHECK(std::ranges::count(bumpy.occluded(down), 1u) == 2000);
    }
}

TEST_CASE("a compressed tree takes few bytes, and holds every triangle once") {
    const World wide = in_layout(World(bumpy_terrain(120)), {});
    const World compressed =
        in_layout(World(bumpy_terrain(120)), {.layout = BvhLayout::compressed});
    const auto triangles = double(wide.bvh.statistics.triangles);
    const double nodes = double(compressed.bvh.compressed.size() * sizeof(BvhCompressed));
    CHECK(nodes / triangles < 20);
    CHECK(compressed.bvh.nodes.empty());
    CHECK(compressed.bvh.slots.size() == wide.bvh.statistics.triangles);
}
