// What a finished tree is expected to cost.
#pragma once

#include "accel/box.h"
#include "accel/bvh.h"

namespace onde::accel {

/// Counts, fill and surface-area cost of the tree. Depth, triangles, instances and seconds are left
/// at 0.
BvhStatistics measure_bvh(const Bvh& bvh, const BvhOptions& options);

/// The bounds of a node's slot; empty where there is no child.
Box slot_box(const BvhNode& node, uint32_t slot);

} // namespace onde::accel
