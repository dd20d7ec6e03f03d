// The chapter's hierarchies (C13): plain trees that hold what the production tree holds.
#include "accel/soups.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace onde;
using namespace onde::test;

namespace {

const std::vector<Placement> ONCE = {{0, glm::mat4(1.0f)}};

Bvh build(const Soup& soup, BvhBuilder builder) {
    const Geometry geometry = soup.geometry();
    return build_bvh({&geometry, 1}, ONCE, {.builder = builder});
}

std::string validate(const Soup& soup, const Bvh& bvh) {
    const Geometry geometry = soup.geometry();
    return validate_bvh(bvh, {&geometry, 1}, ONCE);
}

uint32_t children_of(const BvhNode& node) {
    return uint32_t(BVH_WIDTH - std::count(node.child, node.child + BVH_WIDTH, BVH_NONE));
}
uint32_t triangles_of(const TriangleBlock& block) {
    return uint32_t(BVH_LEAF_WIDTH -
                    std::count(block.primitive, block.primitive + BVH_LEAF_WIDTH, BVH_NONE));
}

} // namespace

TEST_CASE("the median tree is valid, binary, and holds one primitive a leaf") {
    Soup mixed = random_triangles(1000, 0.2f, 1);
    mixed.spheres = random_spheres(100, 0.1f, 2).spheres;
    for (const Soup& soup : {bumpy_terrain(30), mixed, random_triangles(2, 0.5f, 3)}) {
        const Bvh bvh = build(soup, BvhBuilder::median);
        CHECK(validate(soup, bvh) == "");
        CHECK(bvh.blocks.size() == soup.triangles.size());
        for (const TriangleBlock& block : bvh.blocks) REQUIRE(triangles_of(block) == 1);
        for (const BvhNode& node : bvh.nodes) REQUIRE(children_of(node) == 2);
        CHECK(bvh.nodes.size() == soup.size() - 1);
        CHECK(bvh.statistics.depth <= 1 + std::ceil(std::log2(double(soup.size()))));
    }
}

TEST_CASE("spatial cuts add at most as many leaves as there are triangles, and lose none") {
    for (const Soup& soup : {bumpy_terrain(30), random_triangles(2000, 0.4f, 4)}) {
        const Bvh bvh = build(soup, BvhBuilder::median_spatial);
        CHECK(bvh.blocks.size() > soup.triangles.size());
        CHECK(bvh.blocks.size() <= 2 * soup.triangles.size());
        std::set<uint32_t> found;
        for (const TriangleBlock& block : bvh.blocks) {
            REQUIRE(triangles_of(block) == 1);
            found.insert(block.primitive[0]);
        }
        CHECK(found.size() == soup.triangles.size());
        CHECK(validate(soup, bvh) == "");
    }
}

TEST_CASE("spatial cuts shrink the boxes of long triangles") {
    Soup soup; // long ones, crosswise
    Generator generator(5);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 a = uniform_point(generator), d = 2.0f * uniform_point(generator);
        soup.add(a, a + d, a + d + 0.01f * uniform_point(generator));
    }
    CHECK(build(soup, BvhBuilder::median_spatial).statistics.sah_cost <
          0.9 * build(soup, BvhBuilder::median).statistics.sah_cost);
}

TEST_CASE(
    "the list without a hierarchy holds all, eight to a block, under boxes that all contain") {
    const Soup soup = bumpy_terrain(20);
    const Bvh bvh = build(soup, BvhBuilder::none);
    CHECK(validate(soup, bvh) == "");
    CHECK(bvh.blocks.size() == (soup.triangles.size() + 7) / 8);
    for (const BvhNode& node : bvh.nodes)
        for (uint32_t i = 0; i < children_of(node); ++i) REQUIRE(node.low_x[i] < -1e14f);
}

TEST_CASE("plain trees of nothing, of one primitive and of degenerate ones are built") {
    Soup flat, same;
    for (int i = 0; i < 100; ++i) {
        same.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        flat.add({float(i), 0, 0.1f}, {float(i) + 2, 0, 0.1f}, {float(i) + 3, 0, 0.1f});
    }
    for (BvhBuilder builder : {BvhBuilder::median, BvhBuilder::median_spatial, BvhBuilder::none})
        for (const Soup& soup :
             {Soup{}, random_triangles(1, 1, 6), random_spheres(1, 1, 7), same, flat}) {
            const Bvh bvh = build(soup, builder);
            INFO("builder " << int(builder) << ", " << soup.size() << " primitives");
            CHECK(validate(soup, bvh) == "");
            CHECK(bvh.blocks.size() + bvh.spheres.size() >= (soup.size() + 7) / 8);
        }
}
