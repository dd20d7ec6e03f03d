// The records of a wide tree as the kernels read them, one by one.
#pragma once

#include "accel/box.h"
#include "accel/bvh.h"

namespace onde::accel {

void set_slot(BvhNode& node, uint32_t slot, const Box& box, uint32_t word);

/// Puts a triangle into a lane of a block: corners in a watertight tree, else edges.
void set_triangle(TriangleBlock& block, uint32_t lane, const Geometry& geometry, uint32_t index,
                  bool watertight);

/// Matrices, and the child word of the instanced tree's root.
BvhInstance make_instance(const Placement& placement, uint32_t root);

} // namespace onde::accel
