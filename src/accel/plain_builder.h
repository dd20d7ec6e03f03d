// Nodes and leaves of a binary tree as a recursive builder hands them out.
#pragma once

#include "accel/binary.h"

#include <algorithm>

namespace onde::accel {

class PlainBuilder {
  public:
    void set_leaf(uint32_t node, std::span<const Reference> references, const Box& box) {
        nodes_[node] = {
            box.low, box.high, 0, uint32_t(references_.size()), uint32_t(references.size()), 0};
        references_.insert(references_.end(), references.begin(), references.end());
    }

    /// Returns the first of two adjacent children, both still to be set.
    uint32_t set_inner(uint32_t node, uint32_t count, const Box& box) {
        const auto child = uint32_t(nodes_.size());
        nodes_.resize(nodes_.size() + 2);
        nodes_[node] = {box.low, box.high, child, 0, count, 0};
        return child;
    }

    BinaryTree take() {
        BinaryTree tree;
        tree.references = std::move(references_);
        tree.node_count = uint32_t(nodes_.size());
        tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(nodes_.size());
        std::ranges::copy(nodes_, tree.nodes.get());
        return tree;
    }

  private:
    std::vector<BinaryNode> nodes_ = std::vector<BinaryNode>(1); ///< the root
    std::vector<Reference> references_;
};

} // namespace onde::accel
