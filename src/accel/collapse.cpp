#include "accel/collapse.h"

#include "accel/parallel.h"

#include <algorithm>

namespace onde::accel {

Collapse::Collapse(BinaryTree tree, const BvhOptions& options)
    : tree_(std::move(tree)), options_(options), width_(shape_of(options.layout).width),
      shares_(tree_.nodes.size()) {
    // Without a plan every node keeps its two children.
    const bool plain =
        options.builder == BvhBuilder::median || options.builder == BvhBuilder::median_spatial;
    if (!tree_.is_empty() && !plain) plan(0);
}

Collapse::Costs Collapse::plan_leaf(const BinaryNode& node) const {
    Costs costs;
    costs.fill(half_area(node.box()) * options_.leaf_cost);
    return costs;
}

Collapse::Costs Collapse::plan(uint32_t index) {
    constexpr uint32_t TASK_SIZE = 4096;
    const BinaryNode& node = tree_.nodes[index];
    if (node.is_leaf()) return plan_leaf(node);

    Costs left, right;
    run_both(
        options_.parallel && node.count > TASK_SIZE, [&] { left = plan(node.first_child); },
        [&] { right = plan(node.first_child + 1); });

    Costs costs;
    Shares& shares = shares_[index];
    for (uint32_t slots = 2; slots <= width_; ++slots) {
        costs[slots] = left[1] + right[slots - 1];
        shares[slots] = 1;
        for (uint32_t share = 2; share < slots; ++share) {
            const float cost = left[share] + right[slots - share];
            if (cost < costs[slots]) {
                costs[slots] = cost;
                shares[slots] = uint8_t(share);
            }
        }
    }
    costs[1] = half_area(node.box()) * options_.traversal_cost + costs[width_];
    shares[1] = 0;
    for (uint32_t slots = 2; slots < width_; ++slots) {
        if (costs[slots] <= costs[1]) continue;
        costs[slots] = costs[1];
        shares[slots] = 0;
    }
    return costs;
}

ChildList Collapse::children(uint32_t node) const {
    ChildList list;
    const uint32_t left = tree_.nodes[node].first_child, share = shares_[node][width_];
    spread(left, share, list);
    spread(left + 1, width_ - share, list);
    const auto larger = [&](uint32_t a, uint32_t b) {
        return half_area(tree_.nodes[a].box()) > half_area(tree_.nodes[b].box());
    };
    std::sort(list.node.begin(), list.node.begin() + list.count, larger);
    return list;
}

void Collapse::spread(uint32_t node, uint32_t slots, ChildList& list) const {
    const uint32_t share = tree_.nodes[node].is_leaf() ? 0 : shares_[node][slots];
    if (share == 0) {
        list.node[list.count++] = node;
        return;
    }
    spread(tree_.nodes[node].first_child, share, list);
    spread(tree_.nodes[node].first_child + 1, slots - share, list);
}

} // namespace onde::accel
