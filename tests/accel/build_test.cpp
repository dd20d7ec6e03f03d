// The builder's promise: whatever the input, the tree satisfies validate_bvh and does not depend on
// threads. What the tree answers to rays is tested with the kernels.
#include "accel/soups.h"

#include <catch2/catch.hpp>

#include <cstring>

using namespace onde;
using namespace onde::test;

namespace {

const std::vector<Placement> ONCE = {{0, glm::mat4(1.0f)}};

std::string validate(const Soup& soup, const Bvh& bvh) {
    const Geometry geometry = soup.geometry();
    return validate_bvh(bvh, {&geometry, 1}, ONCE);
}

Bvh build(const Soup& soup, const BvhOptions& options = {}) {
    const Geometry geometry = soup.geometry();
    return build_bvh({&geometry, 1}, ONCE, options);
}

void check_valid(const Soup& soup) {
    const Bvh bvh = build(soup);
    CHECK(validate(soup, bvh) == "");
    CHECK(bvh.statistics.triangles == soup.triangles.size());
    CHECK(bvh.statistics.spheres == soup.spheres.size());
}

template <class T>
bool same_bytes(const AlignedVector<T>& a, const AlignedVector<T>& b) {
    if (a.size() != b.size()) return false;
    return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_bits(const Bvh& a, const Bvh& b) {
    return same_bytes(a.nodes, b.nodes) && same_bytes(a.blocks, b.blocks) &&
           same_bytes(a.spheres, b.spheres) && same_bytes(a.instances, b.instances) &&
           a.root == b.root && a.stack_size == b.stack_size;
}

/// Three geometries, one hung directly, two instanced many times.
struct Grove {
    std::vector<Soup> soups;
    std::vector<Geometry> geometries;
    std::vector<Placement> placements;

    explicit Grove(uint32_t triangles) {
        soups = {random_triangles(triangles, 0.1f, 1), random_triangles(triangles, 0.2f, 2),
                 random_spheres(30, 0.2f, 3)};
        uint32_t first = 0;
        for (Soup& soup : soups) {
            soup.first_primitive = first;
            first += soup.size();
            geometries.push_back(soup.geometry());
        }
        Generator generator(4);
        placements.push_back({0, glm::mat4(1.0f)});
        for (uint32_t i = 0; i < 40; ++i)
            placements.push_back({1 + i % 2, random_transform(generator, 5.0f)});
    }
};

} // namespace

TEST_CASE("a tree over random triangles satisfies every invariant") {
    for (uint32_t count : {1u, 2u, 8u, 9u, 17u, 100u, 1000u, 50000u}) {
        INFO(count << " triangles");
        check_valid(random_triangles(count, 0.05f, count));
    }
}

TEST_CASE("a tree over triangles and spheres satisfies every invariant") {
    Soup soup = random_triangles(500, 0.1f, 7);
    soup.spheres = random_spheres(300, 0.1f, 8).spheres;
    soup.first_primitive = 1000;
    check_valid(soup);
    check_valid(random_spheres(1, 1.0f, 9));
    check_valid(random_spheres(200, 0.5f, 10));
}

TEST_CASE("triangles that all lie in one point make a valid tree") {
    Soup soup;
    for (int i = 0; i < 1000; ++i) soup.add(glm::vec3(0.3f), glm::vec3(0.3f), glm::vec3(0.3f));
    check_valid(soup);
}

TEST_CASE("identical triangles make a valid tree") {
    Soup soup;
    for (int i = 0; i < 1000; ++i) soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    check_valid(soup);
}

TEST_CASE("triangles without area, on a line and in a plane, make valid trees") {
    Soup line, plane;
    Generator generator(11);
    for (int i = 0; i < 2000; ++i) {
        const float x = uniform(generator), y = uniform(generator);
        line.add({x, 0, 0}, {x + 0.01f, 0, 0}, {x, 0, 0});
        plane.add({x, y, 0}, {x + 0.01f, y, 0}, {x, y + 0.01f, 0});
    }
    check_valid(line);
    check_valid(plane);
}

TEST_CASE("coordinates from 1e-30 to 1e30 make valid trees") {
    for (float scale : {1e-30f, 1e-20f, 1e-6f, 1e6f, 1e15f, 1e30f}) {
        INFO("scale " << scale);
        check_valid(random_triangles(3000, 0.05f * scale, 12, scale));
    }
    check_valid(random_triangles(3000, 0.5f, 13, 1.0f, glm::vec3(1e6f)));
}

TEST_CASE("sizes that differ by thirty orders of magnitude make a valid tree") {
    Soup soup;
    for (int i = 0; i < 4000; ++i) {
        const float size = std::pow(10.0f, float(i % 300) * 0.1f - 15.0f);
        soup.add(glm::vec3(size), glm::vec3(size, 2 * size, 0), glm::vec3(0, 0, size));
    }
    check_valid(soup);
}

TEST_CASE("a world without primitives is an empty root") {
    for (const std::vector<Placement>& placements : {std::vector<Placement>{}, ONCE}) {
        const Geometry geometry;
        const Bvh bvh = build_bvh({&geometry, 1}, placements);
        CHECK(validate_bvh(bvh, {&geometry, 1}, placements) == "");
        REQUIRE(bvh.nodes.size() == 1);
        CHECK(bvh.root == 0);
        for (uint32_t slot = 0; slot < BVH_WIDTH; ++slot)
            CHECK(bvh.nodes[0].low_x[slot] > bvh.nodes[0].high_x[slot]);
    }
}

TEST_CASE("one triangle is a leaf at the root and needs no stack") {
    const Bvh bvh = build(random_triangles(1, 0.5f, 1));
    CHECK(bvh.root == BVH_LEAF_TRIANGLES);
    CHECK(bvh.nodes.empty());
    CHECK(bvh.stack_size == 1);
}

TEST_CASE("the tree has the same bits with one thread and with many") {
    const BvhOptions serial{.parallel = false};
    const Soup soup = random_triangles(150000, 0.02f, 5);
    CHECK(same_bits(build(soup), build(soup, serial)));

    const Grove grove(20000);
    CHECK(same_bits(build_bvh(grove.geometries, grove.placements),
                    build_bvh(grove.geometries, grove.placements, serial)));
}

TEST_CASE("instances satisfy every invariant and keep their placement's index") {
    const Grove grove(300);
    const Bvh bvh = build_bvh(grove.geometries, grove.placements);
    CHECK(validate_bvh(bvh, grove.geometries, grove.placements) == "");
    CHECK(bvh.has_instances);
    CHECK(bvh.statistics.instances == 40);
    CHECK(bvh.instances.size() == grove.placements.size());
    CHECK(bvh.instances[0].root == BVH_NONE);
    CHECK(bvh.instances[1].root == bvh.instances[3].root);
    CHECK(bvh.instances[5].object_to_world[3] == grove.placements[5].object_to_world[3][0]);
}

TEST_CASE("an instanced geometry is stored once") {
    const Grove grove(300);
    const Bvh bvh = build_bvh(grove.geometries, grove.placements);
    CHECK(bvh.statistics.triangles == 600);
    CHECK(bvh.spheres.size() == 30);
}

TEST_CASE("a geometry placed once by the identity has no instance") {
    const Bvh bvh = build(random_triangles(100, 0.1f, 1));
    CHECK_FALSE(bvh.has_instances);
    CHECK(bvh.statistics.instances == 0);
}

TEST_CASE("geometries that hang directly share one tree") {
    std::vector<Soup> soups = {random_triangles(400, 0.1f, 1), random_triangles(400, 0.1f, 2)};
    soups[1].first_primitive = 400;
    const std::vector<Geometry> geometries = {soups[0].geometry(), soups[1].geometry()};
    const std::vector<Placement> placements = {{0, glm::mat4(1.0f)}, {1, glm::mat4(1.0f)}};
    const Bvh bvh = build_bvh(geometries, placements);
    CHECK(validate_bvh(bvh, geometries, placements) == "");
    CHECK_FALSE(bvh.has_instances);

    const std::vector<Placement> moved = {{0, glm::mat4(1.0f)},
                                          {1, glm::translate(glm::mat4(1.0f), glm::vec3(1.0f))}};
    CHECK(build_bvh(geometries, moved).has_instances);
}

TEST_CASE("blocks and nodes are well filled") {
    const BvhStatistics statistics = build(bumpy_terrain(100)).statistics;
    CHECK(statistics.triangles_per_block > 4.5);
    CHECK(statistics.children_per_node > 7.0);
    CHECK(statistics.sah_cost > 1.0);
    CHECK(statistics.sah_cost < 20.0);
    CHECK(statistics.depth >= 3);
}

TEST_CASE("validation finds each kind of damage") {
    const Soup soup = random_triangles(2000, 0.05f, 21);
    const Bvh good = build(soup);
    REQUIRE(validate(soup, good) == "");

    SECTION("a box that does not contain its child") {
        Bvh bvh = good;
        bvh.nodes[0].high_x[0] = bvh.nodes[0].low_x[0];
        CHECK(validate(soup, bvh).find("does not contain") != std::string::npos);
    }
    SECTION("a missing primitive") {
        Bvh bvh = good;
        bvh.nodes.back().low_x[0] = 1.0f, bvh.nodes.back().high_x[0] = -1.0f;
        CHECK(validate(soup, bvh).find("appears 0 times") != std::string::npos);
    }
    SECTION("ids out of order") {
        Bvh bvh = good;
        std::swap(bvh.blocks[3].primitive[0], bvh.blocks[3].primitive[1]);
        CHECK(validate(soup, bvh) != "");
    }
    SECTION("a moved corner") {
        Bvh bvh = good;
        bvh.blocks[5].e1_y[0] += 0.5f;
        CHECK(validate(soup, bvh).find("other corners") != std::string::npos);
    }
    SECTION("an index out of range") {
        Bvh bvh = good;
        bvh.nodes[0].child[0] = uint32_t(bvh.nodes.size());
        CHECK(validate(soup, bvh).find("out of range") != std::string::npos);
    }
    SECTION("a stack that is too small") {
        Bvh bvh = good;
        bvh.stack_size -= 1;
        CHECK(validate(soup, bvh).find("stack_size") != std::string::npos);
    }
}
