// The chapter's hierarchies (C13) and no hierarchy at all: what the production tree is compared
// with. Simple rather than fast.
#pragma once

#include "accel/binary.h"

namespace onde::accel {

/// Halves the references by their centres along the longest axis, to one reference a leaf.
BinaryTree build_median(std::vector<Reference> references);

/// The same, but a triangle that straddles the plane through the median is cut in two, each half
/// with the box of its part, as long as no more than as many references are added as there were.
BinaryTree build_median_spatial(std::vector<Reference> references,
                                std::span<const Geometry> geometries);

/// Leaves of so many triangles in the order of the references, under boxes so large that no ray
/// misses them.
BinaryTree build_list(std::vector<Reference> references, uint32_t leaf_triangles);

} // namespace onde::accel
