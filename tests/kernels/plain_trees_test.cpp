// Every hierarchy (C13), watertight or not, gives the hits of the production tree.
#include "kernels/traversal_worlds.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::traversal;

TEST_CASE("every builder's tree gives the hits of the production tree") {
    const std::vector<Ray> rays = varied_rays(128); // lists of everything take long
    for (World world : {World(bumpy_terrain(60)), mixed_world(), needles(), grove()})
        for (bool watertight : {false, true}) {
            const std::vector<std::string> defines{fmt::format("ONDE_WATERTIGHT={:d}", watertight)};
            world.bvh = build_bvh(world.geometries, world.placements, {.watertight = watertight});
            Tracer production(world, defines, Abilities::all);
            const std::vector<Hit> expected = production.closest(rays);
            const std::vector<uint32_t> blocked = production.occluded(rays);
            for (BvhBuilder builder : {BvhBuilder::high, BvhBuilder::median,
                                       BvhBuilder::median_spatial, BvhBuilder::none}) {
                world.bvh = build_bvh(world.geometries, world.placements,
                                      {.builder = builder, .watertight = watertight});
                Tracer tracer(world, defines, Abilities::all);
                INFO("builder " << int(builder) << ", watertight " << watertight);
                CHECK(unlike(tracer.closest(rays), expected) == 0);
                CHECK(unlike(tracer.closest_stream(rays), expected) == 0);
                CHECK(differences(tracer.occluded(rays), blocked) == 0);
            }
        }
}
