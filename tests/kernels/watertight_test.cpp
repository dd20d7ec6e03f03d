// The watertight option: no ray leaves a closed mesh through shared edges and corners.
#include "chapter/leak_trials.h"
#include "kernels/traversal_worlds.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::traversal;

namespace {

World watertight_world(Soup soup) {
    World world(std::move(soup));
    world.bvh = build_bvh(world.geometries, world.placements, {.watertight = true});
    REQUIRE(validate_bvh(world.bvh, world.geometries, world.placements) == "");
    return world;
}

const std::vector<std::string> WATERTIGHT{"ONDE_WATERTIGHT=1"};

} // namespace

TEST_CASE("no ray in millions leaks out of closed meshes, round, long, flat or tiny") {
    for (glm::vec3 size :
         {glm::vec3(1), glm::vec3(100, 1, 0.01f), glm::vec3(1e-3f), glm::vec3(3000, 2000, 1000)})
        for (uint32_t subdivisions : {0u, 2u, 5u}) {
            const LeakTrials trials = count_leaks(programs(), subdivisions, size, true, 500'000);
            INFO("size " << size.x << " " << size.y << " " << size.z << ", " << subdivisions
                         << " subdivisions");
            CHECK(trials.rays >= 500'000);
            CHECK(trials.leaks == 0);
        }
}

TEST_CASE("without the option some rays do leak: the count is not blind") {
    const LeakTrials trials = count_leaks(programs(), 5, glm::vec3(1), false, 1'000'000);
    CHECK(trials.leaks > 0);
}

TEST_CASE("the watertight walks agree with each other, bit for bit") {
    const World world = watertight_world(bumpy_terrain(100));
    const std::vector<Ray> rays = varied_rays();
    Tracer fast(world, WATERTIGHT);
    Tracer portable(world, {"ONDE_WATERTIGHT=1", "ONDE_AVX512=0", "ONDE_AVX2=0"});
    const std::vector<Hit> hits = fast.closest(rays);
    for (const std::vector<Hit>& others : fast.closest_by_all(rays))
        CHECK(differences(hits, others) == 0);
    CHECK(differences(fast.occluded(rays), fast.occluded_stream(rays)) == 0);
    CHECK(differences(hits, portable.closest(rays)) == 0);
    CHECK(std::ranges::count_if(hits, is_hit) > ptrdiff_t(rays.size() / 10));
    const std::vector<uint32_t> blocked = fast.occluded(rays);
    for (size_t i = 0; i < rays.size(); ++i) REQUIRE(blocked[i] == uint32_t(is_hit(hits[i])));
}

TEST_CASE("watertight hits are those of the production test, but for close calls") {
    Soup soup = random_triangles(3000, 0.2f, 31);
    const World plain(soup), tight = watertight_world(soup);
    const std::vector<Ray> rays = varied_rays();
    const std::vector<Hit> expected = Tracer(plain).closest(rays);
    const std::vector<Hit> hits = Tracer(tight, WATERTIGHT).closest(rays);
    size_t different = 0;
    double weights = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        different +=
            hits[i].primitive != expected[i].primitive || !same_distance(hits[i].t, expected[i].t);
        if (hits[i].primitive != expected[i].primitive) continue;
        weights = std::max({weights, std::abs(double(hits[i].u) - double(expected[i].u)),
                            std::abs(double(hits[i].v) - double(expected[i].v))});
    }
    CHECK(different <= 5);
    CHECK(weights < 1e-2); // of triangles seen edge on
}
