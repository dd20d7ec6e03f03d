// What several rays have met.
#ifndef ONDE_TRACE_HITS_H
#define ONDE_TRACE_HITS_H

#include "math/lanes.h"

// The closest hits of several rays (see Hit in trace/bvh.h). primitive is BVH_NONE on a miss.
typedef struct {
    real t, u, v;
    natural primitive, instance;
} Hits;

#endif
