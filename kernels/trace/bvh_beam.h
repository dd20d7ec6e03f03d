// Rays of one octant as a beam, tested against the 16 boxes of a node as if it were one ray: bounds
// of where its rays enter and leave them.
#ifndef ONDE_TRACE_BVH_BEAM_H
#define ONDE_TRACE_BVH_BEAM_H

#include "trace/bvh_stream.h"

// By how much a beam is wider than its rays, relative to their coordinates and directions: ten
// times what rounding, SLAB_SLACK and WATERTIGHT_SLACK do to the distances of a ray.
#define BEAM_SLACK 4e-6f

// No ray enters a box before plane * entry + entry_start of its near planes, or the start of the
// ray, nor leaves it after plane * exit + exit_start of its far planes: `entry` is the inverse of
// smallest size, from the origin nearest to the plane, `exit` the one of largest size, from the
// origin farthest from it. Without `valid` there is no beam.
typedef struct {
    float3 entry, entry_start, exit, exit_start;
    uint3 plane; // as in SlabRay
    uint valid;
} Beam;

// The lowest of the lanes in `rays`, and the highest.
typedef struct {
    float low, high;
} Bounds;
INLINE Bounds bounds_of(real16 a, mask16 rays) {
    const Bounds bounds = {lowest_of16(rays ? a : (real16)(INFINITY)),
                           highest_of16(rays ? a : (real16)(-INFINITY))};
    return bounds;
}

// One axis of a beam.
typedef struct {
    float entry, entry_start, exit, exit_start;
} BeamAxis;

INLINE BeamAxis make_beam_axis(const StreamRays* rays, uint axis, mask16 lanes, float reach) {
    const Bounds origin = bounds_of(vload16(0, rays->origin[axis]), lanes);
    const Bounds inverse = bounds_of(vload16(0, rays->inverse[axis]), lanes);
    const float low = origin.low - reach, high = origin.high + reach;
    const bool falls = inverse.high < 0.0f;
    BeamAxis b;
    b.entry = (falls ? inverse.high : inverse.low) * (1.0f - BEAM_SLACK);
    b.exit = (falls ? inverse.low : inverse.high) * (1.0f + BEAM_SLACK);
    b.entry_start = -(falls ? low : high) * b.entry;
    b.exit_start = -(falls ? high : low) * b.exit;
    return b;
}

// Whether the rays in `bits` all rise or all fall along an axis.
INLINE bool goes_one_way(const StreamRays* rays, uint axis, uint bits) {
    const uint falling = bits16(vload16(0, rays->inverse[axis]) < 0.0f) & bits;
    return falling == 0 || falling == bits;
}

// Of the rays in `bits`, all among the first half.
INLINE void make_beam(Beam* beam, const StreamRays* rays, const float* t_min, uint bits) {
    const bool forward = (bits16(vload16(0, t_min) < 0.0f) & bits) == 0;
    beam->valid = bits && forward && goes_one_way(rays, 0, bits) && goes_one_way(rays, 1, bits) &&
                  goes_one_way(rays, 2, bits);
    if (!beam->valid) return;
    const mask16 lanes = lanes16(bits);
    const real16 largest = watertight_reach16(
        vload16(0, rays->origin[0]), vload16(0, rays->origin[1]), vload16(0, rays->origin[2]));
    const float reach =
        highest_of16(lanes ? largest : (real16)(0.0f)) * (BEAM_SLACK / WATERTIGHT_SLACK);
    const BeamAxis x = make_beam_axis(rays, 0, lanes, reach);
    const BeamAxis y = make_beam_axis(rays, 1, lanes, reach);
    const BeamAxis z = make_beam_axis(rays, 2, lanes, reach);
    beam->entry = (float3)(x.entry, y.entry, z.entry);
    beam->exit = (float3)(x.exit, y.exit, z.exit);
    beam->entry_start = (float3)(x.entry_start, y.entry_start, z.entry_start);
    beam->exit_start = (float3)(x.exit_start, y.exit_start, z.exit_start);
    const uint first = lowest_bit(bits);
    beam->plane = stream_slab(rays, first).plane;
}

// The children whose boxes some ray of the beam may meet, and where it enters them at the earliest.
INLINE NodeHits beam_meets_node(__global const uchar* node, const Beam* b) {
    const real16 near_x = slab_distance(node, b->plane.x, b->entry.x, b->entry_start.x);
    const real16 near_y = slab_distance(node, b->plane.y, b->entry.y, b->entry_start.y);
    const real16 near_z = slab_distance(node, b->plane.z, b->entry.z, b->entry_start.z);
    const real16 far_x = slab_distance(node, b->plane.x ^ 64, b->exit.x, b->exit_start.x);
    const real16 far_y = slab_distance(node, b->plane.y ^ 64, b->exit.y, b->exit_start.y);
    const real16 far_z = slab_distance(node, b->plane.z ^ 64, b->exit.z, b->exit_start.z);
    const real16 near = max_fast(max_fast(near_x, near_y), max_fast(near_z, (real16)(0.0f)));
    const real16 far = min_fast(min_fast(far_x, far_y), far_z);
    const NodeHits hits = {near, lower_bits16(near, far)};
    return hits;
}

#endif
