// The binary tree that the wide one is made from.
#pragma once

#include "accel/reference.h"

#include <atomic>
#include <memory>
#include <span>
#include <vector>

namespace onde::accel {

/// An inner node has two adjacent children; a leaf has references that share a block, or one
/// single. Trivial, so that an array of them costs nothing before it is filled.
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
    std::vector<Reference> references; ///< partitioned
    std::unique_ptr<BinaryNode[]> nodes;
    uint32_t node_count = 0;

    bool is_empty() const { return references.empty(); }
    bool is_single(const BinaryNode& leaf) const { return references[leaf.begin].is_single(); }
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
