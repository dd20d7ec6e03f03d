// Which binary nodes become wide ones: the choice of least surface-area cost.
#pragma once

#include "accel/binary.h"

#include <array>
#include <vector>

namespace onde::accel {

/// Up to 16 binary nodes that are the children of one wide node, largest surface first.
struct ChildList {
    std::array<uint32_t, BVH_WIDTH> node;
    uint32_t count = 0;

    const uint32_t* begin() const { return node.data(); }
    const uint32_t* end() const { return node.data() + count; }
};

/// A binary tree, and for each of its nodes the best way to spread over wide nodes.
class Collapse {
  public:
    /// Minimises sum(area(node) traversal_cost) + sum(area(leaf) leaf_cost) over all wide trees
    /// that keep the binary tree's leaves: the dynamic programme of Ylitie, Karras and Laine,
    /// "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", 2017,
    /// section 3.1.
    Collapse(BinaryTree tree, const BvhOptions& options);

    const BinaryTree& tree() const { return tree_; }

    /// The children of the wide node that stands for inner node `node` and all that it absorbs.
    ChildList children(uint32_t node) const;

  private:
    /// Least cost of a subtree that may fill [slots] slots of the node above it; [0] is unused.
    using Costs = std::array<float, BVH_WIDTH + 1>;
    /// Slots that go left when [slots] may be filled; 0: the subtree becomes one wide node.
    using Shares = std::array<uint8_t, BVH_WIDTH + 1>;

    Costs plan(uint32_t node);
    Costs plan_leaf(const BinaryNode& node) const;
    void spread(uint32_t node, uint32_t slots, ChildList& list) const;

    BinaryTree tree_;
    BvhOptions options_;
    uint32_t width_; ///< children of a node
    std::vector<Shares> shares_;
};

} // namespace onde::accel
