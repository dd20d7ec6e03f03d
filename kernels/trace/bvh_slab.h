// A ray against the 16 boxes of a node.
#ifndef ONDE_TRACE_BVH_SLAB_H
#define ONDE_TRACE_BVH_SLAB_H

#include "trace/bvh_bits.h"

// The distance to a plane is plane * inverse - origin * inverse, one fma. Its rounding error grows
// with |origin * inverse|; intervals are widened by this part of it, at no cost per box. With the
// builder's margin no rounding can then make a ray miss a box that it meets, from wherever it
// comes.
#define SLAB_SLACK 2.4e-7f

// What the slab test needs of a ray. `plane` is the byte offset of an axis' near planes in a node;
// the far planes are at plane ^ 64.
typedef struct {
    float3 inverse, near, far;
    uint3 plane;
} SlabRay;

INLINE float safe_inverse(float direction) {
    // A finite stand-in for infinity keeps 0 * infinity out of the slab test.
    return 1.0f / (fabs(direction) < 1e-18f ? copysign(1e-18f, direction) : direction);
}

// In a watertight tree, by this part of the origin's largest coordinate instead: the test of
// triangles shears corners along the ray, which moves them across it by rounding of that size.
#define WATERTIGHT_SLACK 6e-7f

INLINE float largest_coordinate(float3 v) {
    const float3 size = fabs(v);
    return max_fast(size.x, max_fast(size.y, size.z));
}

INLINE SlabRay make_slab_ray(float3 origin, float3 direction) {
    SlabRay ray;
    ray.inverse =
        (float3)(safe_inverse(direction.x), safe_inverse(direction.y), safe_inverse(direction.z));
    const float3 start = -origin * ray.inverse;
#if ONDE_WATERTIGHT
    const float3 slack = fabs(ray.inverse) * (largest_coordinate(origin) * WATERTIGHT_SLACK);
#else
    const float3 slack = fabs(start) * SLAB_SLACK;
#endif
    ray.near = start - slack;
    ray.far = start + slack;
    ray.plane.x = ray.inverse.x < 0.0f ? 64 : 0;
    ray.plane.y = ray.inverse.y < 0.0f ? 192 : 128;
    ray.plane.z = ray.inverse.z < 0.0f ? 320 : 256;
    return ray;
}

INLINE real16 node_row(__global const uchar* node, uint offset) {
    return *(__global const real16*)(node + offset);
}

INLINE real16 slab_distance(__global const uchar* node, uint plane, float inverse, float start) {
    return fma(node_row(node, plane), (real16)(inverse), (real16)(start));
}

// Where a ray enters the 16 boxes of a node, and where it leaves them; it misses those that it
// would leave first.
typedef struct {
    real16 near, far;
} BoxSpans;

INLINE BoxSpans span_boxes(__global const uchar* node, SlabRay ray, float t_min, float t_max) {
    const real16 near_x = slab_distance(node, ray.plane.x, ray.inverse.x, ray.near.x);
    const real16 near_y = slab_distance(node, ray.plane.y, ray.inverse.y, ray.near.y);
    const real16 near_z = slab_distance(node, ray.plane.z, ray.inverse.z, ray.near.z);
    const real16 far_x = slab_distance(node, ray.plane.x ^ 64, ray.inverse.x, ray.far.x);
    const real16 far_y = slab_distance(node, ray.plane.y ^ 64, ray.inverse.y, ray.far.y);
    const real16 far_z = slab_distance(node, ray.plane.z ^ 64, ray.inverse.z, ray.far.z);
    const real16 near_xy = max_fast(near_x, near_y), near_zt = max_fast(near_z, (real16)(t_min));
    const real16 far_xy = min_fast(far_x, far_y), far_zt = min_fast(far_z, (real16)(t_max));
    const BoxSpans spans = {max_fast(near_xy, near_zt), min_fast(far_xy, far_zt)};
    return spans;
}

// The children whose boxes the ray meets within [t_min, t_max], a bit each, and where it does.
typedef struct {
    real16 near;
    uint bits;
} NodeHits;

INLINE NodeHits meet_node(__global const uchar* node, SlabRay ray, float t_min, float t_max) {
    const BoxSpans spans = span_boxes(node, ray, t_min, t_max);
    const NodeHits hits = {spans.near, lower_bits16(spans.near, spans.far)};
    return hits;
}

// One axis of what the slab test needs of 16 rays, as in SlabRay.
typedef struct {
    real16 inverse, near, far;
} SlabAxis16;

INLINE real16 safe_inverse16(real16 direction) {
    return 1.0f / (fabs(direction) < 1e-18f ? copysign((real16)(1e-18f), direction) : direction);
}

// By how much of |inverse| the rays are widened in a watertight tree: all axes need the same.
INLINE real16 watertight_reach16(real16 x, real16 y, real16 z) {
    return WATERTIGHT_SLACK * max_fast(fabs(x), max_fast(fabs(y), fabs(z)));
}

INLINE SlabAxis16 make_slab_axis16(real16 origin, real16 direction, real16 reach) {
    SlabAxis16 axis;
    axis.inverse = safe_inverse16(direction);
    const real16 start = -origin * axis.inverse;
#if ONDE_WATERTIGHT
    const real16 slack = fabs(axis.inverse) * reach;
#else
    const real16 slack = fabs(start) * SLAB_SLACK;
#endif
    axis.near = start - slack;
    axis.far = start + slack;
    return axis;
}

#endif
