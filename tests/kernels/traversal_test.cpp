// What the kernels' walks answer: against brute force in double precision, against Embree, and
// against each other, bit by bit.
#include "kernels/traversal_checks.h"
#include "kernels/traversal_worlds.h"
#include "scene/load.h"
#include "support/assets.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::traversal;

TEST_CASE("closest and any hits on triangles are those of brute force") {
    check_against_brute_force(World(random_triangles(400, 0.3f, 1)), random_rays(20000, 2));
}

TEST_CASE("closest and any hits on spheres are those of brute force") {
    check_against_brute_force(World(random_spheres(200, 0.2f, 3)), random_rays(20000, 4));
}

TEST_CASE("closest and any hits on instances are those of brute force") {
    check_against_brute_force(grove(), random_rays(10000, 5, 4.0f));
}

TEST_CASE("a tree that is a single leaf answers like brute force") {
    check_against_brute_force(World(random_triangles(5, 1.0f, 6)), random_rays(5000, 7));
    check_against_brute_force(World(random_spheres(1, 1.0f, 8)), random_rays(5000, 9));
}

TEST_CASE("a million rays at a bumpy terrain hit what Embree says") {
    check_against_embree(
        bumpy_terrain(200),
        join(pinhole_rays(700, {1.2f, 0.9f, 1.5f}, {0, 0, 0}, 1.2f), random_rays(510000, 10)));
}

TEST_CASE("a million rays at a scanned bunny hit what Embree says") {
    const auto path = find_asset("obj/stanford-bunny.obj");
    if (!path) return;
    const Scene scene = load_scene(*path);
    Soup soup;
    soup.positions = scene.meshes.at(0).positions;
    soup.triangles = scene.meshes.at(0).triangles;
    const SceneBounds bounds = scene_bounds(scene);
    for (glm::vec3& position : soup.positions)
        position = (position - 0.5f * (bounds.low + bounds.high)) /
                   glm::length(bounds.high - bounds.low) * 2.0f;
    check_against_embree(std::move(soup), join(pinhole_rays(700, {0, 0.4f, 2}, {0, 0, 0}, 1.0f),
                                               random_rays(510000, 11, 1.0f)));
}

TEST_CASE("streams and interleaved rays answer like single rays, bit for bit") {
    const std::vector<Ray> rays = varied_rays();
    Soup mixed = random_triangles(2000, 0.1f, 12);
    mixed.spheres = random_spheres(300, 0.1f, 13).spheres;
    for (const World& world : {World(bumpy_terrain(150)), World(std::move(mixed)), grove(),
                               World(random_triangles(6, 1.0f, 14))})
        for (const char* alone : {"STREAM_ALONE=0", "STREAM_ALONE=3"}) {
            Tracer tracer(world, {alone});
            const std::vector<Hit> single = tracer.closest(rays);
            for (const std::vector<Hit>& hits : tracer.closest_by_all(rays))
                CHECK(differences(single, hits) == 0);
            CHECK(differences(tracer.occluded(rays), tracer.occluded_stream(rays)) == 0);
        }
}

TEST_CASE("streams and interleaved rays keep each ray's own interval") {
    std::vector<Ray> rays = varied_rays();
    Generator generator(51);
    for (Ray& ray : rays) {
        ray.t_min = uniform(generator, 0.0f, 1.5f);
        ray.t_max = ray.t_min + uniform(generator, -0.1f, 1.5f);
    }
    for (const World& world : {World(bumpy_terrain(100)), grove()}) {
        Tracer tracer(world);
        CHECK(differences(tracer.closest(rays), tracer.closest_stream(rays)) == 0);
        CHECK(differences(tracer.closest(rays), tracer.closest_interleaved(rays)) == 0);
        CHECK(differences(tracer.occluded(rays), tracer.occluded_stream(rays)) == 0);
    }
}

TEST_CASE("a group of rays that is not full answers for its rays alone") {
    const World world(bumpy_terrain(20));
    Tracer tracer(world);
    const std::vector<Ray> rays = random_rays(37, 15, 1.0f);
    const std::vector<Hit> single = tracer.closest(rays);
    for (const std::vector<Hit>& hits : tracer.closest_by_all(rays))
        CHECK(differences(single, hits) == 0);
    CHECK(differences(tracer.occluded(rays), tracer.occluded_stream(rays)) == 0);
}

TEST_CASE("the portable code answers like that with machine instructions, bit for bit") {
    const std::vector<Ray> rays = varied_rays();
    for (const World& world : {World(bumpy_terrain(150)), grove()}) {
        Tracer fast(world);
        Tracer portable(world, {"ONDE_AVX512=0", "ONDE_AVX2=0"});
        const std::vector<Hit> hits = fast.closest(rays);
        for (const std::vector<Hit>& others : portable.closest_by_all(rays))
            CHECK(differences(hits, others) == 0);
        CHECK(differences(fast.occluded(rays), portable.occluded(rays)) == 0);
        CHECK(differences(fast.occluded_stream(rays), portable.occluded_stream(rays)) == 0);
    }
}

TEST_CASE("hits do not depend on the tree's shape") {
    const std::vector<Ray> rays = varied_rays();
    World world(random_triangles(5000, 0.1f, 16));
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    world.bvh = build_bvh(world.geometries, world.placements, {.bins = 4, .traversal_cost = 8.0f});
    const std::vector<Hit> others = Tracer(world).closest(rays);
    size_t different = 0;
    for (size_t i = 0; i < rays.size(); ++i)
        different += hits[i].primitive != others[i].primitive ||
                     !same_distance(hits[i].t, others[i].t, 1e-6f);
    CHECK(different == 0);
}

TEST_CASE("a refitted tree finds the hits of a tree that is built anew") {
    const std::vector<Ray> rays = varied_rays(128);
    World world = grove();
    Generator generator(23);
    for (Soup& soup : world.soups) {
        for (glm::vec3& position : soup.positions) position += 0.2f * uniform_point(generator);
        for (SphereInput& sphere : soup.spheres) sphere.center += 0.2f * uniform_point(generator);
    }
    for (size_t i = 1; i < world.placements.size(); ++i)
        world.placements[i].object_to_world = random_transform(generator, 2.0f);
    refit_bvh(world.bvh, world.geometries, world.placements);
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    world.bvh = build_bvh(world.geometries, world.placements);
    CHECK(unlike(hits, Tracer(world).closest(rays)) == 0);
    CHECK(std::ranges::count_if(hits, is_hit) > 1000);
}

TEST_CASE("the distance to a narrow triangle does not suffer from a far origin") {
    Soup soup;
    std::vector<Ray> rays;
    Generator generator(22);
    for (int i = 0; i < 500; ++i) { // a hundredth long, a hundred-thousandth high
        const glm::vec3 corner = uniform_point(generator);
        const glm::vec3 along = 0.01f * glm::normalize(uniform_point(generator));
        const glm::vec3 height =
            1e-5f * glm::normalize(glm::cross(along, uniform_point(generator)));
        soup.add(corner, corner + along, corner + 0.5f * along + height);
        const glm::vec3 origin = 4.0f * glm::normalize(glm::cross(along, height));
        rays.push_back({origin, 0.0f, corner + 0.5f * along + 0.4f * height - origin, 1e30f});
    }
    const World world(std::move(soup));
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    const BruteForce exact(world, 0);
    size_t found = 0, off = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const Hit expected = exact.closest(rays[i]);
        if (!is_hit(hits[i]) || !same_primitive(hits[i], expected)) continue;
        ++found;
        off += !same_distance(hits[i].t, expected.t, 3e-6f);
    }
    CHECK(found > 400);
    CHECK(off == 0);
}

TEST_CASE("of triangles in one place the one with the smallest id is hit") {
    Soup soup;
    for (int i = 0; i < 100; ++i) soup.add({-1, -1, 0}, {2, -1, 0}, {-1, 2, 0});
    const World world(std::move(soup));
    Tracer tracer(world);
    std::vector<Ray> rays;
    Generator generator(18);
    for (int i = 0; i < 1000; ++i) {
        const float x = uniform(generator, -0.8f, 0.4f), y = uniform(generator, -0.8f, 0.4f);
        rays.push_back({{x, y, 3}, 0.0f, {0.01f, 0.02f, -1}, 1e30f});
    }
    for (const std::vector<Hit>& hits : tracer.closest_by_all(rays))
        CHECK(std::ranges::all_of(hits, [](const Hit& hit) { return hit.primitive == 0; }));
}

TEST_CASE("axis-parallel rays in the planes of boxes find the triangles there") {
    // A grid of squares in z = 0 whose edges, and so whose boxes, lie at multiples of 1/8.
    Soup soup;
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; ++column) {
            const glm::vec3 corner(0.125f * float(column), 0.125f * float(row), 0.0f);
            const glm::vec3 x(0.125f, 0, 0), y(0, 0.125f, 0);
            soup.add(corner, corner + x, corner + y);
            soup.add(corner + x + y, corner + y, corner + x);
        }
    const World world(std::move(soup));
    std::vector<Ray> rays;
    for (int row = 1; row < 32; ++row)
        for (int column = 1; column < 32; ++column)
            for (float z : {1.0f, -1.0f})
                for (float zero : {0.0f, -0.0f})
                    rays.push_back({{0.0625f * float(column), 0.0625f * float(row), z},
                                    0.0f,
                                    {zero, zero, -z},
                                    1e30f});
    Tracer tracer(world);
    const std::vector<uint32_t> blocked = tracer.occluded(rays);
    for (const std::vector<Hit>& hits : tracer.closest_by_all(rays))
        for (size_t i = 0; i < rays.size(); ++i) {
            INFO("ray " << i);
            REQUIRE(is_hit(hits[i]));
            REQUIRE(hits[i].t == 1.0f);
            REQUIRE(blocked[i] == 1);
        }
}

TEST_CASE("rays along z that start on a box plane find the next triangle") {
    Soup soup;
    for (int i = 0; i < 64; ++i) {
        const float z = float(i);
        soup.add({0, 0, z}, {1, 0, z}, {0, 1, z});
    }
    const World world(std::move(soup));
    std::vector<Ray> rays;
    for (int i = 0; i < 64; ++i) rays.push_back({{0.25f, 0.25f, float(i)}, 0.0f, {0, 0, 1}, 1e30f});
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    for (uint32_t i = 0; i < 63; ++i) {
        CHECK(hits[i].primitive == i + 1);
        CHECK(hits[i].t == 1.0f);
    }
    CHECK(hits[63].primitive == BVH_NONE);
    CHECK(hits[63].t == 1e30f);
}

TEST_CASE("a hit lies in the half-open interval from t_min to t_max") {
    Soup soup;
    soup.add({0, 0, 2}, {1, 0, 2}, {0, 1, 2});
    const World world(std::move(soup));
    Tracer tracer(world);
    const auto hits = [&](float t_min, float t_max) {
        const std::vector<Ray> rays = {{{0.25f, 0.25f, 0}, t_min, {0, 0, 1}, t_max}};
        const bool closest = is_hit(tracer.closest(rays)[0]);
        for (const std::vector<Hit>& found : tracer.closest_by_all(rays))
            CHECK(closest == is_hit(found[0]));
        CHECK(closest == bool(tracer.occluded(rays)[0]));
        CHECK(closest == bool(tracer.occluded_stream(rays)[0]));
        return closest;
    };
    CHECK(hits(0.0f, 3.0f));
    CHECK(hits(0.0f, 2.0f));
    CHECK_FALSE(hits(0.0f, 1.9999f));
    CHECK(hits(1.9999f, 3.0f));
    CHECK_FALSE(hits(2.0f, 3.0f));
    CHECK(hits(0.0f, INFINITY));
}

TEST_CASE("rays with NaN or infinity, and rays into an empty world, hit nothing") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = INFINITY;
    std::vector<Ray> rays;
    for (float bad : {nan, infinity, -infinity})
        for (int place = 0; place < 6; ++place) {
            Ray ray = {{0, 0, 3}, 0.0f, {0, 0, -1}, 1e30f};
            (place < 3 ? ray.origin : ray.direction)[glm::length_t(place % 3)] = bad;
            rays.push_back(ray);
        }
    Soup mixed = random_triangles(500, 0.5f, 19);
    mixed.spheres = {{glm::vec3(0.0f), 1.0f}};
    for (const World& world : {World(std::move(mixed)), World(Soup{}), grove()}) {
        Tracer tracer(world);
        const std::vector<Ray> asked =
            world.geometries[0].triangles.empty() ? random_rays(100, 20) : rays;
        for (const std::vector<Hit>& hits : tracer.closest_by_all(asked))
            CHECK(std::ranges::none_of(hits, is_hit));
        for (uint32_t blocked : tracer.occluded(asked)) CHECK(blocked == 0);
        for (uint32_t blocked : tracer.occluded_stream(asked)) CHECK(blocked == 0);
    }
}

TEST_CASE("rays from twenty world extents away still find the ground") {
    constexpr float FAR = 8.0f;
    const World world(bumpy_terrain(50));
    Generator generator(21);
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 target(uniform(generator, -0.9f, 0.9f), 0, uniform(generator, -0.9f, 0.9f));
        const glm::vec3 origin = target + FAR * glm::vec3(0.3f, 5.0f, -0.2f);
        rays.push_back({origin, 0.0f, target - origin, 1e30f});
    }
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    CHECK(std::ranges::count_if(hits, is_hit) >= 1999);
}
