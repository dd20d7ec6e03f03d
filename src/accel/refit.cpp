// A tree whose primitives have moved: the same nodes around new boxes.
#include "accel/parallel.h"
#include "accel/records.h"
#include "accel/reference.h"
#include "accel/statistics.h"
#include "accel/wide.h"

#include "core/error.h"
#include "core/timer.h"

#include <algorithm>

namespace onde {

using namespace accel;

namespace {

class Refitter {
  public:
    Refitter(Bvh& bvh, std::span<const Geometry> geometries, std::span<const Placement> placements,
             bool parallel)
        : bvh_(bvh), placements_(placements), parallel_(parallel), block_boxes_(bvh.blocks.size()),
          node_boxes_(bvh.nodes.size()) {
        for (const Geometry& geometry : geometries)
            if (geometry.size() > 0) owners_.push_back(&geometry);
        std::ranges::sort(owners_, {}, &Geometry::first_primitive);
    }

    void refit() {
        for_each_index(bvh_.blocks.size(), parallel_, [&](size_t i) { refit_block(i); });
        for (BvhSphere& sphere : bvh_.spheres) refit_sphere(sphere);
        refit_instances();
        // Children come after their parents, and the trees of instances after the world's.
        for (size_t i = bvh_.nodes.size(); i-- > 0;) refit_node(i);
    }

  private:
    const Geometry& owner(uint32_t primitive) const {
        const auto next =
            std::ranges::upper_bound(owners_, primitive, {}, &Geometry::first_primitive);
        if (next == owners_.begin()) fail();
        const Geometry& found = **std::prev(next);
        if (primitive - found.first_primitive >= found.size()) fail();
        return found;
    }

    [[noreturn]] static void fail() {
        throw InputError("a tree can be fitted to moved vertices, but not to other primitives than "
                         "those that it was built over; build it anew");
    }

    void refit_block(size_t i) {
        TriangleBlock& block = bvh_.blocks[i];
        for (uint32_t lane = 0; lane < BVH_LEAF_WIDTH && block.primitive[lane] != BVH_NONE;
             ++lane) {
            const Geometry& geometry = owner(block.primitive[lane]);
            const uint32_t index = block.primitive[lane] - geometry.first_primitive;
            if (index >= geometry.triangles.size()) fail();
            set_triangle(block, lane, geometry, index, bvh_.watertight);
            block_boxes_[i].extend(triangle_box(geometry, index));
        }
    }

    void refit_instances() {
        std::vector<uint32_t> roots; // by geometry
        for (size_t i = 0; i < placements_.size(); ++i) {
            const uint32_t geometry = placements_[i].geometry;
            roots.resize(std::max<size_t>(roots.size(), geometry + 1), BVH_NONE);
            roots[geometry] = bvh_.instances[i].root;
        }
        put_instances(placements_, roots, bvh_.instances);
    }

    void refit_sphere(BvhSphere& out) const {
        const Geometry& geometry = owner(out.primitive);
        const size_t sphere = out.primitive - geometry.first_primitive - geometry.triangles.size();
        if (sphere >= geometry.spheres.size()) return; // a shape, which moves with its instance
        const SphereInput& input = geometry.spheres[sphere];
        std::copy_n(&input.center.x, 3, out.center);
        out.radius = input.radius;
    }

    void refit_node(size_t i) {
        BvhNode& node = bvh_.nodes[i];
        for (uint32_t slot = 0; slot < BVH_WIDTH; ++slot) {
            const uint32_t word = node.child[slot];
            if (word == BVH_NONE) continue;
            const Box box = box_below(word);
            set_slot(node, slot, padded(box), word);
            node_boxes_[i].extend(box);
        }
    }

    /// Unpadded, of all below a child word.
    Box box_below(uint32_t word) const {
        if (!(word & BVH_LEAF)) return node_boxes_[word];
        const uint32_t index = word & BVH_INDEX_MASK;
        switch (word & BVH_KIND_MASK) {
        case BVH_LEAF_TRIANGLES:
            return block_boxes_[index];
        case BVH_LEAF_INSTANCE:
            return placed_box(box_below(bvh_.instances[index].root), placements_[index]);
        default: {
            const uint32_t primitive = bvh_.spheres[index].primitive;
            const Geometry& geometry = owner(primitive);
            return single_box(geometry, primitive - geometry.first_primitive);
        }
        }
    }

    Bvh& bvh_;
    std::span<const Placement> placements_;
    bool parallel_;
    std::vector<const Geometry*> owners_; ///< by their first primitive
    std::vector<Box> block_boxes_, node_boxes_;
};

} // namespace

void refit_bvh(Bvh& bvh, std::span<const Geometry> geometries,
               std::span<const Placement> placements, const BvhOptions& options) {
    const Timer timer;
    if (bvh.layout != BvhLayout::wide || placements.size() != bvh.placements)
        throw InputError("only a wide tree can be fitted to moved vertices, under as many "
                         "placements as it was built for; build it anew");
    Refitter(bvh, geometries, placements, options.parallel).refit();
    bvh.refitted = true;
    const BvhStatistics before = bvh.statistics;
    bvh.statistics = measure_bvh(bvh, options);
    bvh.statistics.triangles = before.triangles;
    bvh.statistics.instances = before.instances;
    bvh.statistics.depth = before.depth;
    bvh.statistics.build_seconds = timer.seconds();
}

} // namespace onde
