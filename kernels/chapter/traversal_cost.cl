// Recorded rays through the tree, and what it took: for each ray the boxes and primitives tested,
// and whether it hit. Rays are as in trace/query.cl; compile with ONDE_TRAVERSAL_COST=1.
#include "trace/bvh.h"

__kernel void count_tests(uint count, BVH_SCALARS, __global const float8* rays,
                          __global uint* tests) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const BvhView bvh = BVH_FROM_SCALARS;
    const float8 ray = rays[i];
    const Hit hit = bvh_closest(bvh, ray.s012, ray.s3, ray.s456, ray.s7);
#if ONDE_TRAVERSAL_COST
    tests[3 * i] = hit.boxes;
    tests[3 * i + 1] = hit.primitives;
#endif
    tests[3 * i + 2] = hit.primitive != BVH_NONE;
}
