// The layout for GPUs: nodes of 8 children in 80 bytes, traversed by one ray.
#ifndef ONDE_TRACE_LAYOUT_COMPRESSED_H
#define ONDE_TRACE_LAYOUT_COMPRESSED_H

#define ONDE_BVH_LAYOUT BVH_LAYOUT_COMPRESSED

#include "trace/bvh_compressed.h"

#endif
