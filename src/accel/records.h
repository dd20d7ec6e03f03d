// The records of a wide tree as the kernels read them, one by one.
#pragma once

#include "accel/box.h"
#include "accel/bvh.h"

namespace onde::accel {

void set_slot(BvhNode& node, uint32_t slot, const Box& box, uint32_t word);

/// Puts a triangle into a lane of a block: corners in a watertight tree, else edges.
void set_triangle(TriangleBlock& block, uint32_t lane, const Geometry& geometry, uint32_t index,
                  bool watertight);

/// Matrices, and the child word of the instanced tree's root; of what moves all but its keys'
/// place.
BvhInstance make_instance(const Placement& placement, uint32_t root);

/// Puts the keys of the instance at `index`, which is the placement, behind all others.
void put_keys(const Placement& placement, AlignedVector<BvhInstance>& instances, size_t index);

/// All instances of placements, then the keys of those that move, as in Bvh. roots: by geometry.
void put_instances(std::span<const Placement> placements, std::span<const uint32_t> roots,
                   AlignedVector<BvhInstance>& instances);

/// Bounds in the world of a placed thing that has this box in its own space, wherever it moves.
Box placed_box(const Box& box, const Placement& placement);

} // namespace onde::accel
