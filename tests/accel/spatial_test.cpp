// The production tree of high quality: spatial splits within a budget.
#include "accel/soups.h"

#include <catch2/catch.hpp>

#include <cstring>

using namespace onde;
using namespace onde::test;

namespace {

const std::vector<Placement> ONCE = {{0, glm::mat4(1.0f)}};

Bvh build(const Soup& soup, BvhOptions options = {}) {
    const Geometry geometry = soup.geometry();
    if (options.builder == BvhBuilder::sah) options.builder = BvhBuilder::high;
    return build_bvh({&geometry, 1}, ONCE, options);
}

double cost_of_sah(const Soup& soup) {
    const Geometry geometry = soup.geometry();
    return build_bvh({&geometry, 1}, ONCE, {.builder = BvhBuilder::sah}).statistics.sah_cost;
}

std::string validate(const Soup& soup, const Bvh& bvh) {
    const Geometry geometry = soup.geometry();
    return validate_bvh(bvh, {&geometry, 1}, ONCE);
}

/// Long thin triangles, crosswise.
Soup needles(int count, float length, unsigned seed) {
    Soup soup;
    Generator generator(seed);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 a = uniform_point(generator), d = length * uniform_point(generator);
        soup.add(a, a + d, a + d + 0.01f * uniform_point(generator));
    }
    return soup;
}

/// Some of them among many small triangles.
Soup few_needles() {
    Soup soup = needles(150, 2.0f, 38);
    const Soup small = random_triangles(3000, 0.03f, 42);
    for (size_t i = 0; i < small.positions.size(); i += 3)
        soup.add(small.positions[i], small.positions[i + 1], small.positions[i + 2]);
    return soup;
}

template <class T>
bool same_bytes(const AlignedVector<T>& a, const AlignedVector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void check_valid(const Soup& soup) {
    const Bvh bvh = build(soup);
    CHECK(validate(soup, bvh) == "");
    CHECK(bvh.statistics.triangles == soup.triangles.size());
    CHECK(bvh.statistics.references >= soup.triangles.size());
    CHECK(bvh.statistics.spheres == soup.spheres.size());
}

} // namespace

TEST_CASE("trees with spatial splits satisfy every invariant, whatever the triangles") {
    for (int count : {1, 2, 8, 9, 17, 100, 1000, 20000}) {
        INFO(count << " triangles");
        check_valid(random_triangles(uint32_t(count), 0.3f, unsigned(count)));
        check_valid(needles(count, 2.0f, unsigned(count)));
    }
    check_valid(bumpy_terrain(60));
    check_valid(random_triangles(3000, 2.0f, 31, 1.0f, glm::vec3(1e5f)));
}

TEST_CASE("spheres are never cut, among triangles that are") {
    Soup soup = needles(2000, 1.0f, 32);
    soup.spheres = random_spheres(500, 0.3f, 33).spheres;
    check_valid(soup);
    check_valid(random_spheres(300, 0.5f, 34));
    const Bvh bvh = build(soup);
    CHECK(bvh.spheres.size() == 500);
}

TEST_CASE("spatial splits cope with equal, flat, coplanar and degenerate triangles") {
    Soup same, point, line, plane, crossing;
    Generator generator(35);
    for (int i = 0; i < 1500; ++i) {
        const float x = uniform(generator), y = uniform(generator), turn = 0.004f * float(i);
        same.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0.5f});
        point.add(glm::vec3(0.3f), glm::vec3(0.3f), glm::vec3(0.3f));
        line.add({x, 0, 0}, {x + 0.5f, 0, 0}, {x, 0, 0});
        plane.add({x, 1, y}, {x + 0.3f, 1, y}, {x, 1, y + 0.4f});
        const glm::vec3 arm(std::cos(turn), std::sin(turn), 0.5f); // all have one centre
        crossing.add(-arm, arm, arm);
    }
    for (const Soup& soup : {same, point, line, plane, crossing}) check_valid(soup);
}

TEST_CASE("spatial splits cope with coordinates from 1e-30 to 1e30") {
    for (float scale : {1e-30f, 1e-20f, 1e-6f, 1e6f, 1e15f, 1e30f}) {
        INFO("scale " << scale);
        check_valid(random_triangles(2000, 0.8f * scale, 36, scale));
    }
    Soup soup;
    for (int i = 0; i < 3000; ++i) {
        const float size = std::pow(10.0f, float(i % 300) * 0.1f - 15.0f);
        soup.add(glm::vec3(-size), glm::vec3(size, 2 * size, 0), glm::vec3(0, 0, size));
    }
    check_valid(soup);
}

TEST_CASE("spatial splits add references, though no more than they may") {
    for (const Soup& soup : {few_needles(), needles(5000, 1.0f, 37)})
        for (float extra : {0.0f, 0.01f, 0.1f, 0.3f, 1.0f}) {
            INFO(soup.size() << " triangles, extra " << extra);
            const Bvh bvh = build(soup, {.extra_references = extra});
            CHECK(validate(soup, bvh) == "");
            const uint32_t added = bvh.statistics.references - soup.size();
            if (extra >= 0.1f) CHECK(added > 0);
            CHECK(double(added) <= double(extra) * soup.size() + 0.5);
        }
}

TEST_CASE("spatial splits lower the cost where some triangles are long") {
    const Soup soup = few_needles();
    const double cost = cost_of_sah(soup);
    CHECK(build(soup).statistics.sah_cost < 0.8 * cost);
    CHECK(build(soup, {.extra_references = 1.0f}).statistics.sah_cost < 0.7 * cost);
}

TEST_CASE("spatial splits cost no more where all triangles are long, or none") {
    for (const Soup& soup : {needles(5000, 0.5f, 38), needles(5000, 2.0f, 38), bumpy_terrain(60)})
        CHECK(build(soup).statistics.sah_cost <= 1.02 * cost_of_sah(soup));
}

TEST_CASE("a tree with spatial splits has the same bits with one thread and with many") {
    for (const Soup& soup : {needles(50000, 0.3f, 39), random_triangles(60000, 0.1f, 40)}) {
        const Bvh a = build(soup), b = build(soup, {.parallel = false});
        CHECK(same_bytes(a.nodes, b.nodes));
        CHECK(same_bytes(a.blocks, b.blocks));
        CHECK(a.stack_size == b.stack_size);
    }
}

TEST_CASE("validation finds a triangle whose leaves do not cover it") {
    const Soup soup = needles(500, 2.0f, 41);
    Bvh bvh = build(soup);
    REQUIRE(validate(soup, bvh) == "");
    for (BvhNode& node : bvh.nodes) {
        for (uint32_t slot = 0; slot < BVH_WIDTH; ++slot)
            if ((node.child[slot] & (BVH_LEAF | BVH_KIND_MASK)) == BVH_LEAF_TRIANGLES)
                node.high_x[slot] = 0.5f * (node.low_x[slot] + node.high_x[slot]);
    }
    CHECK(validate(soup, bvh).find("do not contain all") != std::string::npos);
}
