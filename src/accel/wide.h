// A 16-wide tree before and while it is written into its place among the others.
#pragma once

#include "accel/collapse.h"

#include <span>
#include <vector>

namespace onde::accel {

/// What a subtree takes up in the device arrays, and what traversing it takes.
struct WideSize {
    uint32_t nodes = 0, blocks = 0, spheres = 0;
    uint32_t depth = 0; ///< wide nodes on the longest way down, through instances as well
    uint32_t stack = 0; ///< most entries that wait while anything in the subtree is visited
};

/// Where a subtree's first node, block and sphere go.
struct WidePlace {
    uint32_t node = 0, block = 0, sphere = 0;

    void advance(const WideSize& size) {
        node += size.nodes;
        block += size.blocks;
        sphere += size.spheres;
    }
};

/// The shape of one wide tree. Leaves that are instances have the size that `instances` says.
class WideTree {
  public:
    /// instances[i] is the size of the tree that placement i shows.
    WideTree(std::vector<Reference> references, std::span<const WideSize> instances,
             std::span<const Geometry> geometries, const BvhOptions& options);

    WideSize size() const { return root_size_; }
    /// Unpadded bounds.
    Box box() const;

    /// Writes the tree at `place`, the node of its root first; returns the child word of its root.
    uint32_t emit(std::span<const Geometry> geometries, const WidePlace& place, Bvh& out) const;

  private:
    WideSize measure_root(std::span<const WideSize> instances);
    WideSize measure(uint32_t node, std::span<const WideSize> instances);
    WideSize measure_leaf(const BinaryNode& leaf, std::span<const WideSize> instances) const;

    Collapse collapse_;
    bool parallel_, root_is_node_;
    std::vector<WideSize> sizes_; ///< of the binary nodes that became wide ones
    WideSize root_size_;

    friend class Emitter;
};

/// The node that has no children; the root of an empty tree.
BvhNode empty_node();

/// Enlarged by 2^-21 of its largest absolute coordinate: with the slack for the ray's part in the
/// kernels' slab test, no rounding there, nor in edges stored as differences, makes a ray miss the
/// box of a triangle that it hits.
Box padded(const Box& box);

/// Transforms the corners of `box` and bounds them.
Box transformed(const Box& box, const glm::mat4& transform);

} // namespace onde::accel
