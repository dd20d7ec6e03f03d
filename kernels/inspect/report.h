// Writing down what a ray met. Width 1 only: a report is a struct in memory.
#ifndef ONDE_INSPECT_REPORT_H
#define ONDE_INSPECT_REPORT_H

#include "shade/surface.h"
#include "shared/inspect.h"

INLINE void report3(__global float* to, real3 from) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

INLINE void report_hit(__global HitReport* to, real3 origin, real3 direction, Hits hit, Surface s) {
    const bool found = hit.primitive != BVH_NONE;
    report3(to->origin, origin);
    report3(to->direction, direction);
    to->t = found ? hit.t : 0.0f;
    to->primitive = hit.primitive;
    to->instance = hit.instance;
    to->material = found ? s.material : 0;
    to->front = found && s.front;
    report3(to->position, found ? s.position : zero3());
    report3(to->normal, found ? s.normal : zero3());
}

#endif
