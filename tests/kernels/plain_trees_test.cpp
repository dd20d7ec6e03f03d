// Every hierarchy (C13), watertight or not, gives the hits of the production tree.
#include "kernels/traversal_rig.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::traversal;

namespace {

/// Hits that are not the same triangle at the same distance, give or take rounding.
size_t unlike(const std::vector<Hit>& hits, const std::vector<Hit>& expected) {
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i)
        count += hits[i].primitive != expected[i].primitive ||
                 hits[i].instance != expected[i].instance ||
                 !same_distance(hits[i].t, expected[i].t, 1e-6f);
    return count;
}

World mixed_world() {
    Soup soup = random_triangles(1500, 0.3f, 41);
    soup.spheres = random_spheres(100, 0.1f, 42).spheres;
    return World(std::move(soup));
}

/// Long thin triangles, crosswise, some far larger than the rest and far from the origin: most of
/// them are cut many times.
World needles() {
    Soup soup;
    Generator generator(43);
    for (int i = 0; i < 1500; ++i) {
        const float length = i % 10 == 0 ? 30.0f : 2.0f;
        const glm::vec3 middle = uniform_point(generator), d = length * uniform_point(generator);
        soup.add(middle - d, middle + d, middle + d + 0.05f * uniform_point(generator));
    }
    return World(std::move(soup));
}

} // namespace

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
                CHECK(unlike(tracer.closest_packet(rays), expected) == 0);
                CHECK(differences(tracer.occluded(rays), blocked) == 0);
            }
        }
}
