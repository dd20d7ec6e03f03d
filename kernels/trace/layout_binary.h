// The plainest layout: both boxes of a node in 64 bytes, traversed by one ray.
#ifndef ONDE_TRACE_LAYOUT_BINARY_H
#define ONDE_TRACE_LAYOUT_BINARY_H

#define ONDE_BVH_LAYOUT BVH_LAYOUT_BINARY

#include "trace/bvh_binary.h"

#endif
