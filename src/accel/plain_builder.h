// Nodes and leaves of a binary tree as a recursive builder hands them out.
#pragma once

#include "accel/binary.h"

namespace onde::accel {

class PlainBuilder {
  public:
    PlainBuilder() { tree_.nodes.grow_by(1); } // the root

    void set_leaf(uint32_t node, std::span<const Reference> references, const Box& box) {
        tree_.nodes[node] = {
            box.low, box.high, 0, uint32_t(tree_.origins.size()), uint32_t(references.size()), 0};
        for (const Reference& reference : references) tree_.origins.push_back(reference.origin());
    }

    /// Returns the first of two adjacent children, both still to be set.
    uint32_t set_inner(uint32_t node, uint32_t count, const Box& box) {
        const uint32_t child = tree_.add_children();
        tree_.nodes[node] = {box.low, box.high, child, 0, count, 0};
        return child;
    }

    BinaryTree take() { return std::move(tree_); }

  private:
    BinaryTree tree_;
};

} // namespace onde::accel
