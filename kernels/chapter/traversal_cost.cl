// Recorded rays through the tree, and what it took: for each ray the boxes and primitives tested,
// and whether it hit. Rays are as in trace/query.cl; compile with ONDE_TRAVERSAL_COST=1.
#include "trace/bvh.h"

__kernel void count_tests(uint count, __global const uchar* nodes, __global const uchar* blocks,
                          __global const BvhSphere* spheres, __global const BvhInstance* instances,
                          uint root, __global const float8* rays, __global uint* tests) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const BvhView bvh = {nodes, blocks, spheres, instances, root};
    const float8 ray = rays[i];
    const Hit hit = bvh_closest(bvh, ray.s012, ray.s3, ray.s456, ray.s7);
#if ONDE_TRAVERSAL_COST
    tests[3 * i] = hit.boxes;
    tests[3 * i + 1] = hit.primitives;
#endif
    tests[3 * i + 2] = hit.primitive != BVH_NONE;
}
