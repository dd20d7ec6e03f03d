// A tree as the arrays that its kernels read, still in host memory. Pure.
#pragma once

#include "accel/bvh.h"

#include <span>

namespace onde {

/// Nodes and leaves as bytes, of the tree's layout. Views of the tree's memory.
struct BvhArrays {
#define ONDE_ARRAY(Type, name, words) std::span<const Type> name;
    BVH_BUFFERS(ONDE_ARRAY)
#undef ONDE_ARRAY
};

BvhArrays bvh_arrays(const Bvh& bvh);

} // namespace onde
