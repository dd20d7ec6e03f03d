// The binary tree that the wide one is made from.
#pragma once

#include "accel/reference.h"

#include <tbb/concurrent_vector.h>

#include <span>
#include <vector>

namespace onde::accel {

/// An inner node has two adjacent children; a leaf has references that share a block, or one
/// single.
struct BinaryNode {
    Lanes low, high;
    uint32_t first_child; ///< 0: a leaf (the root is nobody's child)
    uint32_t begin;       ///< of its references
    uint32_t count;
    uint32_t unused;

    bool is_leaf() const { return first_child == 0; }
    Box box() const { return {low, high}; }
};

/// Node 0 is the root. The order of the other nodes depends on threads; the shape does not.
struct BinaryTree {
    std::vector<Origin> origins; ///< of the references that the nodes count
    tbb::concurrent_vector<BinaryNode> nodes;

    bool is_empty() const { return nodes.empty(); }

    /// Two adjacent nodes, still to be set; returns the first. Safe from several threads.
    uint32_t add_children() { return uint32_t(nodes.grow_by(2) - nodes.begin()); }
    /// Boxes are no longer wanted when a tree is split; they are most of a reference.
    void keep_origins(std::span<const Reference> references) {
        origins.reserve(references.size());
        for (const Reference& reference : references) origins.push_back(reference.origin());
    }
};

/// What the nodes and leaves of a layout hold.
struct TreeShape {
    uint32_t width;          ///< children of a node
    uint32_t leaf_triangles; ///< of a leaf
    bool root_is_node;       ///< even of a tree that is a single leaf
};

inline TreeShape shape_of(BvhLayout layout) {
    switch (layout) {
    case BvhLayout::compressed:
        return {COMPRESSED_WIDTH, COMPRESSED_LEAF, true};
    case BvhLayout::binary:
        return {2, BINARY_LEAF, true};
    case BvhLayout::wide:
        break;
    }
    return {BVH_WIDTH, BVH_LEAF_WIDTH, false};
}

/// Splits the references top-down until every leaf fits the layout or is a single.
BinaryTree build_binary(std::vector<Reference> references, const BvhOptions& options);

/// The same with spatial splits where those are cheaper, so that a triangle may be in several
/// leaves (but once in each). There are at most 1 + options.extra_references times as many
/// references.
BinaryTree build_binary_spatial(std::vector<Reference> references,
                                std::span<const Geometry> geometries, const BvhOptions& options);

} // namespace onde::accel
