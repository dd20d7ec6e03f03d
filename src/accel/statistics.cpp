#include "accel/statistics.h"

#include <algorithm>
#include <map>

namespace onde::accel {

namespace {

/// Expected cost of a random ray that meets a subtree's box, after MacDonald and Booth, "Heuristics
/// for ray tracing using space subdivision", 1990.
class CostModel {
  public:
    CostModel(const Bvh& bvh, const BvhOptions& options) : bvh_(bvh), options_(options) {}

    double cost(uint32_t word) {
        if (!(word & BVH_LEAF)) return cost_of_node(bvh_.nodes[word]);
        const bool is_instance = (word & BVH_KIND_MASK) == BVH_LEAF_INSTANCE;
        return is_instance ? cost_of_instance(word & BVH_INDEX_MASK) : options_.leaf_cost;
    }

  private:
    double cost_of_node(const BvhNode& node) {
        Box box;
        double weighted = 0;
        for (uint32_t slot = 0; slot < BVH_WIDTH && node.child[slot] != BVH_NONE; ++slot) {
            const Box child = slot_box(node, slot);
            box.extend(child);
            weighted += half_area(child) * cost(node.child[slot]);
        }
        const double area = half_area(box);
        return options_.traversal_cost + (area > 0 ? weighted / area : 0);
    }

    double cost_of_instance(uint32_t instance) {
        const uint32_t root = bvh_.instances[instance].root;
        const auto known = instanced_.find(root);
        return known != instanced_.end() ? known->second : instanced_[root] = cost(root);
    }

    const Bvh& bvh_;
    const BvhOptions& options_;
    std::map<uint32_t, double> instanced_; ///< by root
};

uint32_t count_children(const BvhNode& node) {
    return uint32_t(BVH_WIDTH - std::count(node.child, node.child + BVH_WIDTH, BVH_NONE));
}

uint32_t count_triangles(const TriangleBlock& block) {
    const uint32_t* ids = block.primitive;
    return uint32_t(BVH_LEAF_WIDTH - std::count(ids, ids + BVH_LEAF_WIDTH, BVH_NONE));
}

bool is_sphere(const BvhSphere& sphere) {
    return sphere.kind == BVH_NONE;
}

} // namespace

Box slot_box(const BvhNode& node, uint32_t slot) {
    return {Lanes{node.low_x[slot], node.low_y[slot], node.low_z[slot], 0.0f},
            Lanes{node.high_x[slot], node.high_y[slot], node.high_z[slot], 0.0f}};
}

BvhStatistics measure_bvh(const Bvh& bvh, const BvhOptions& options) {
    BvhStatistics statistics;
    statistics.nodes = uint32_t(bvh.nodes.size());
    statistics.blocks = uint32_t(bvh.blocks.size());
    statistics.spheres = uint32_t(std::ranges::count_if(bvh.spheres, is_sphere));
    statistics.shapes = uint32_t(bvh.spheres.size()) - statistics.spheres;
    double children = 0;
    for (const BvhNode& node : bvh.nodes) children += count_children(node);
    for (const TriangleBlock& block : bvh.blocks) statistics.references += count_triangles(block);
    statistics.children_per_node = children / std::max(1.0, double(bvh.nodes.size()));
    statistics.triangles_per_block =
        double(statistics.references) / std::max(1.0, double(bvh.blocks.size()));
    statistics.sah_cost = CostModel(bvh, options).cost(bvh.root);
    return statistics;
}

} // namespace onde::accel
