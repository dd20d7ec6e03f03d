// The layouts for GPUs, read back: boxes that only grew, and every primitive where it was.
#include "accel/soups.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace onde::test {
namespace {

Bvh build(const Soup& soup, BvhBuilder builder, BvhLayout layout) {
    const Geometry geometry = soup.geometry();
    const Placement placement;
    return build_bvh({&geometry, 1}, {&placement, 1}, {.builder = builder, .layout = layout});
}

/// Whether the triangle of a slot lies in the box.
bool contains(const double (&low)[3], const double (&high)[3], const BvhSlot& slot) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float edge : {0.0f, slot.e1[axis], slot.e2[axis]}) {
            const double corner = double(slot.v0[axis]) + edge;
            if (corner < low[axis] || corner > high[axis]) return false;
        }
    return true;
}

void decode(const BvhCompressed& node, uint32_t slot, double (&low)[3], double (&high)[3]) {
    const uchar* lows[3] = {node.low_x, node.low_y, node.low_z};
    const uchar* highs[3] = {node.high_x, node.high_y, node.high_z};
    for (int axis = 0; axis < 3; ++axis) {
        const double step = std::ldexp(1.0, int(node.exponent[axis]) - 127);
        low[axis] = double(node.origin[axis]) + step * lows[axis][slot];
        high[axis] = double(node.origin[axis]) + step * highs[axis][slot];
    }
}

/// Every slot below a node lies in the boxes of all nodes above it.
void check_node(const Bvh& bvh, uint32_t index, std::vector<BvhSlot>& below) {
    REQUIRE(index < bvh.compressed.size());
    const BvhCompressed& node = bvh.compressed[index];
    uint32_t child = node.child;
    for (uint32_t slot = 0; slot < COMPRESSED_WIDTH; ++slot) {
        std::vector<BvhSlot> found;
        if (node.inner >> slot & 1) {
            REQUIRE(node.leaf[slot] == 0);
            check_node(bvh, child++, found);
        } else if (node.leaf[slot] != 0) {
            const uint32_t first = node.slot + (node.leaf[slot] & 31u);
            const uint32_t count = node.leaf[slot] >> 5;
            REQUIRE(count <= COMPRESSED_LEAF);
            REQUIRE(first + count <= bvh.slots.size());
            found.assign(bvh.slots.begin() + first, bvh.slots.begin() + first + count);
        }
        double low[3], high[3];
        decode(node, slot, low, high);
        for (const BvhSlot& primitive : found) REQUIRE(contains(low, high, primitive));
        below.insert(below.end(), found.begin(), found.end());
    }
}

} // namespace

TEST_CASE("compressed boxes contain what they contained, whatever the size of the world") {
    for (const float scale : {1.0f, 1e-12f, 3e7f, 1e15f})
        for (const BvhBuilder builder : {BvhBuilder::sah, BvhBuilder::median}) {
            Soup soup = random_triangles(700, 0.3f, 5);
            for (glm::vec3& position : soup.positions) position *= scale;
            Bvh bvh = build(soup, builder, BvhLayout::compressed);
            compact_bvh(bvh, BvhLayout::compressed);
            std::vector<BvhSlot> found;
            INFO("scale " << scale);
            check_node(bvh, bvh.root, found);
            std::set<uint32_t> ids;
            for (const BvhSlot& slot : found) ids.insert(slot.primitive);
            CHECK(found.size() == 700);
            CHECK(ids.size() == 700);
        }
}

TEST_CASE("pairs have the boxes of the wide tree, and every triangle once") {
    const Soup soup = random_triangles(700, 0.3f, 6);
    Bvh bvh = build(soup, BvhBuilder::sah, BvhLayout::binary);
    std::vector<float> lows;
    for (const BvhNode& node : bvh.nodes) lows.insert(lows.end(), node.low_x, node.low_x + 2);
    compact_bvh(bvh, BvhLayout::binary);
    std::vector<float> narrow;
    std::set<uint32_t> ids;
    for (const BvhPair& pair : bvh.pairs) {
        narrow.insert(narrow.end(), pair.low_x, pair.low_x + 2);
        for (const uint32_t word : pair.child) {
            if (!(word & BVH_LEAF) || word == BVH_NONE) continue;
            const uint32_t first = word & ((1u << BINARY_COUNT_SHIFT) - 1);
            const uint32_t count = (word >> BINARY_COUNT_SHIFT & 3) + 1;
            for (uint32_t i = first; i < first + count; ++i) ids.insert(bvh.slots.at(i).primitive);
        }
    }
    std::ranges::sort(lows);
    std::ranges::sort(narrow);
    CHECK(lows == narrow);
    CHECK(ids.size() == 700);
    CHECK(bvh.slots.size() == 700);
}

} // namespace onde::test
