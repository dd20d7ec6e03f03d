// The layout for CPUs: nodes of 16 children, leaves of 8 triangles, traversed by one ray, by a
// stream or by interleaved rays.
#ifndef ONDE_TRACE_LAYOUT_WIDE_H
#define ONDE_TRACE_LAYOUT_WIDE_H

#define ONDE_BVH_LAYOUT BVH_LAYOUT_WIDE

#include "trace/bvh_interleaved.h"
#include "trace/bvh_stream_closest.h"
#include "trace/bvh_stream_occluded.h"
#include "trace/bvh_wide.h"

#endif
