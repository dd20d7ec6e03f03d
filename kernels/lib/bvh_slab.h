// A ray against the 16 boxes of a node.
#ifndef ONDE_LIB_BVH_SLAB_H
#define ONDE_LIB_BVH_SLAB_H

#include "lib/bvh_bits.h"

// Distances to far planes are taken this much too long: with the builder's margin no rounding can
// then make a ray miss a box (Ize, "Robust BVH ray traversal", 2013).
#define SLAB_SLACK 4.8e-7f

// What the slab test needs of a ray. `near` is the byte offset of an axis' near planes in a node;
// the far planes are at near ^ 64.
typedef struct {
    float3 origin, inverse;
    uint3 near;
} SlabRay;

INLINE float safe_inverse(float direction) {
    // A finite stand-in for infinity keeps 0 * infinity out of the slab test.
    return 1.0f / (fabs(direction) < 1e-18f ? copysign(1e-18f, direction) : direction);
}

INLINE SlabRay make_slab_ray(float3 origin, float3 direction) {
    SlabRay ray;
    ray.origin = origin;
    ray.inverse =
        (float3)(safe_inverse(direction.x), safe_inverse(direction.y), safe_inverse(direction.z));
    ray.near.x = ray.inverse.x < 0.0f ? 64 : 0;
    ray.near.y = ray.inverse.y < 0.0f ? 192 : 128;
    ray.near.z = ray.inverse.z < 0.0f ? 320 : 256;
    return ray;
}

INLINE float16 node_row(__global const uchar* node, uint offset) {
    return *(__global const float16*)(node + offset);
}

// The children whose boxes the ray meets within [t_min, t_max], a bit each, and where it does.
typedef struct {
    float16 near;
    uint bits;
} NodeHits;

INLINE NodeHits meet_node(__global const uchar* node, SlabRay ray, float t_min, float t_max) {
    const float3 inverse_far = ray.inverse * (1.0f + SLAB_SLACK);
    const float16 near_x = (node_row(node, ray.near.x) - ray.origin.x) * ray.inverse.x;
    const float16 near_y = (node_row(node, ray.near.y) - ray.origin.y) * ray.inverse.y;
    const float16 near_z = (node_row(node, ray.near.z) - ray.origin.z) * ray.inverse.z;
    const float16 far_x = (node_row(node, ray.near.x ^ 64) - ray.origin.x) * inverse_far.x;
    const float16 far_y = (node_row(node, ray.near.y ^ 64) - ray.origin.y) * inverse_far.y;
    const float16 far_z = (node_row(node, ray.near.z ^ 64) - ray.origin.z) * inverse_far.z;
    const float16 near_xy = UPPER(near_x, near_y), near_zt = UPPER(near_z, (float16)(t_min));
    const float16 far_xy = LOWER(far_x, far_y), far_zt = LOWER(far_z, (float16)(t_max));
    NodeHits hits;
    hits.near = UPPER(near_xy, near_zt);
    hits.bits = lower_bits16(hits.near, LOWER(far_xy, far_zt));
    return hits;
}

#endif
