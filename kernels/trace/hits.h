// What several rays have met, and where that lies in memory.
#ifndef ONDE_TRACE_HITS_H
#define ONDE_TRACE_HITS_H

#include "trace/columns.h"

// The closest hits of several rays (see Hit in trace/bvh.h). primitive is BVH_NONE on a miss.
COLUMNS_TYPE(Hits, HIT_COLUMNS);
COLUMNS_ACCESS(Hits, hits, HIT_COLUMNS)
COLUMNS_CHOICE(Hits, HIT_COLUMNS)

#endif
