// The tree, walked by 16 rays together: for primary rays, which go almost the same way. A frustum
// of intervals is tested against the 16 children of a node at once, then each box that survives
// against the 16 rays; in a leaf the rays that are left go one by one, unless most are. Answers are
// those of bvh_closest, bit for bit.
#ifndef ONDE_TRACE_BVH_PACKET_H
#define ONDE_TRACE_BVH_PACKET_H

#include "trace/bvh_stream_closest.h"

#if ONDE_INSTANCES

// Rays that leave for an instance's space no longer share a frustum: in company.
OUTLINED void bvh_closest_packet(BVH_SCALARS, StreamRays* rays, const float* t_min,
                                 StreamHits* hits, uint bits) {
    bvh_closest_stream(nodes, blocks, spheres, instances, root, rays, t_min, hits, bits);
}

#else

typedef struct {
    Vectors16 origin, direction;
    Vectors16 inverse, near, far; // as in SlabRay
    float16 t_min;
} Packet;

// Rays of one octant as intervals: of their origins, by the end that is nearer to the near planes
// of each axis, and the other; and of their inverse directions.
typedef struct {
    float3 near_origin, far_origin, lowest_inverse, highest_inverse;
    uint3 plane; // as in SlabRay
    float t_min;
} Frustum;

    // How much a frustum is wider than its rays, relative to their origins and directions; more
    // than what rounding and SLAB_SLACK do to the distances of each ray.
    #define FRUSTUM_SLACK 2e-6f

INLINE Packet load_packet(const StreamRays* rays, const float* t_min) {
    Packet packet;
    packet.origin.x = vload16(0, rays->origin[0]);
    packet.origin.y = vload16(0, rays->origin[1]);
    packet.origin.z = vload16(0, rays->origin[2]);
    packet.t_min = vload16(0, t_min);
    packet.direction.x = vload16(0, rays->direction[0]);
    packet.direction.y = vload16(0, rays->direction[1]);
    packet.direction.z = vload16(0, rays->direction[2]);
    const float16 reach = watertight_reach16(packet.origin.x, packet.origin.y, packet.origin.z);
    const SlabAxis16 x = make_slab_axis16(packet.origin.x, packet.direction.x, reach);
    const SlabAxis16 y = make_slab_axis16(packet.origin.y, packet.direction.y, reach);
    const SlabAxis16 z = make_slab_axis16(packet.origin.z, packet.direction.z, reach);
    const Vectors16 inverse = {x.inverse, y.inverse, z.inverse};
    const Vectors16 near = {x.near, y.near, z.near}, far = {x.far, y.far, z.far};
    packet.inverse = inverse;
    packet.near = near;
    packet.far = far;
    return packet;
}

INLINE int16 finite_rays(Packet packet) {
    const float16 x = (packet.origin.x + packet.direction.x) * 0.0f;
    const float16 y = (packet.origin.y + packet.direction.y) * 0.0f;
    const float16 z = (packet.origin.z + packet.direction.z) * 0.0f;
    return x + y + z == 0.0f;
}

INLINE int16 lanes_of(uint bits) {
    const int16 places = (int16)(0x1, 0x2, 0x4, 0x8, 0x10, 0x20, 0x40, 0x80, 0x100, 0x200, 0x400,
                                 0x800, 0x1000, 0x2000, 0x4000, 0x8000);
    return ((int16)((int)bits) & places) != 0;
}

INLINE uint16 octants(Packet packet) {
    const int16 signs = ((packet.inverse.x < 0.0f) & 1) | ((packet.inverse.y < 0.0f) & 2) |
                        ((packet.inverse.z < 0.0f) & 4);
    return as_uint16(signs);
}

INLINE float lowest_in(float16 a, int16 lanes) {
    return lowest_of16(lanes ? a : (float16)(INFINITY));
}
INLINE float highest_in(float16 a, int16 lanes) {
    return highest_of16(lanes ? a : (float16)(-INFINITY));
}

INLINE float3 lowest3(Vectors16 v, int16 lanes) {
    const float3 lowest =
        (float3)(lowest_in(v.x, lanes), lowest_in(v.y, lanes), lowest_in(v.z, lanes));
    return lowest - fabs(lowest) * FRUSTUM_SLACK;
}
INLINE float3 highest3(Vectors16 v, int16 lanes) {
    const float3 highest =
        (float3)(highest_in(v.x, lanes), highest_in(v.y, lanes), highest_in(v.z, lanes));
    return highest + fabs(highest) * FRUSTUM_SLACK;
}

INLINE Frustum make_frustum(Packet packet, int16 lanes, uint octant) {
    float3 low = lowest3(packet.origin, lanes), high = highest3(packet.origin, lanes);
    #if ONDE_WATERTIGHT
    const float reach = largest_coordinate(max_fast(fabs(low), fabs(high)));
    low -= reach * FRUSTUM_SLACK;
    high += reach * FRUSTUM_SLACK;
    #endif
    const int3 flipped = ((int3)(octant) & (int3)(1, 2, 4)) != 0;
    Frustum frustum;
    frustum.near_origin = flipped ? low : high;
    frustum.far_origin = flipped ? high : low;
    frustum.lowest_inverse = lowest3(packet.inverse, lanes);
    frustum.highest_inverse = highest3(packet.inverse, lanes);
    frustum.plane = (uint3)(octant & 1 ? 64 : 0, octant & 2 ? 192 : 128, octant & 4 ? 320 : 256);
    frustum.t_min = lowest_in(packet.t_min, lanes);
    return frustum;
}

// Bounds of the distances at which the frustum's rays cross planes.
INLINE float16 earliest(float16 planes, float origin, float lowest, float highest) {
    const float16 way = planes - origin;
    return min_fast(way * lowest, way * highest);
}
INLINE float16 latest(float16 planes, float origin, float lowest, float highest) {
    const float16 way = planes - origin;
    return max_fast(way * lowest, way * highest);
}

INLINE NodeHits frustum_meets_node(__global const uchar* node, Frustum f, float t_max) {
    const float16 near_x = earliest(node_row(node, f.plane.x), f.near_origin.x, f.lowest_inverse.x,
                                    f.highest_inverse.x);
    const float16 near_y = earliest(node_row(node, f.plane.y), f.near_origin.y, f.lowest_inverse.y,
                                    f.highest_inverse.y);
    const float16 near_z = earliest(node_row(node, f.plane.z), f.near_origin.z, f.lowest_inverse.z,
                                    f.highest_inverse.z);
    const float16 far_x = latest(node_row(node, f.plane.x ^ 64), f.far_origin.x, f.lowest_inverse.x,
                                 f.highest_inverse.x);
    const float16 far_y = latest(node_row(node, f.plane.y ^ 64), f.far_origin.y, f.lowest_inverse.y,
                                 f.highest_inverse.y);
    const float16 far_z = latest(node_row(node, f.plane.z ^ 64), f.far_origin.z, f.lowest_inverse.z,
                                 f.highest_inverse.z);
    const float16 near_xy = max_fast(near_x, near_y),
                  near_zt = max_fast(near_z, (float16)(f.t_min));
    const float16 far_xy = min_fast(far_x, far_y), far_zt = min_fast(far_z, (float16)(t_max));
    NodeHits hits;
    hits.near = max_fast(near_xy, near_zt);
    hits.bits = lower_bits16(hits.near, min_fast(far_xy, far_zt));
    return hits;
}

// Where each ray enters one box, and which rays do; as meet_node, ray by ray.
typedef struct {
    float16 near;
    int16 lanes;
} BoxHits;

INLINE BoxHits rays_meet_box(__global const float* box, Frustum f, Packet rays, float16 t_max) {
    const uint plane_x = f.plane.x / 4, plane_y = f.plane.y / 4, plane_z = f.plane.z / 4;
    const float16 in_x = fma((float16)(box[plane_x]), rays.inverse.x, rays.near.x);
    const float16 in_y = fma((float16)(box[plane_y]), rays.inverse.y, rays.near.y);
    const float16 in_z = fma((float16)(box[plane_z]), rays.inverse.z, rays.near.z);
    const float16 out_x = fma((float16)(box[plane_x ^ 16]), rays.inverse.x, rays.far.x);
    const float16 out_y = fma((float16)(box[plane_y ^ 16]), rays.inverse.y, rays.far.y);
    const float16 out_z = fma((float16)(box[plane_z ^ 16]), rays.inverse.z, rays.far.z);
    const float16 in_xy = max_fast(in_x, in_y), in_zt = max_fast(in_z, rays.t_min);
    const float16 out_xy = min_fast(out_x, out_y), out_zt = min_fast(out_z, t_max);
    BoxHits hits;
    hits.near = max_fast(in_xy, in_zt);
    hits.lanes = hits.near <= min_fast(out_xy, out_zt);
    return hits;
}

INLINE Vectors16 splat16(__global const float* rows, uint lane) {
    const Vectors16 vectors = {(float16)(rows[lane]), (float16)(rows[8 + lane]),
                               (float16)(rows[16 + lane])};
    return vectors;
}

// As meet_block, triangle by triangle.
INLINE void meet_triangles(__global const uchar* block, Packet rays, BoxHits box,
                           StreamHits* hits) {
    __global const float* rows = (__global const float*)block;
    const uint box_bits = bits16(box.lanes);
    float16 t_max = vload16(0, hits->t), u = vload16(0, hits->u), v = vload16(0, hits->v);
    uint16 primitives = vload16(0, hits->primitive);
    for (uint i = 0; i < BVH_LEAF_WIDTH; i++) {
        const uint primitive = as_uint(rows[72 + i]);
        if (primitive == BVH_NONE) break;
        const TriangleTest16 test = leaf_test16(rays.origin, rays.direction, splat16(rows, i),
                                                splat16(rows + 24, i), splat16(rows + 48, i));
        if (!(box_bits & ~sign_bits16(test.outside))) continue;
        const int16 miss = miss16(test, rays.t_min, t_max);
        if (!(box_bits & ~sign_bits16(miss))) continue;
        const float16 inverse = 1.0f / test.determinant;
        const float16 t = test.t * inverse;
        const float16 from_box = max_fast(t, box.near);
        const int16 closer =
            box.lanes & (miss >= 0) & (t > rays.t_min) &
            ((from_box < t_max) | ((from_box == t_max) & ((uint16)(primitive) < primitives)));
        t_max = closer ? from_box : t_max;
        u = closer ? test.u * inverse : u;
        v = closer ? test.v * inverse : v;
        primitives = closer ? (uint16)(primitive) : primitives;
    }
    vstore16(t_max, 0, hits->t);
    vstore16(u, 0, hits->u);
    vstore16(v, 0, hits->v);
    vstore16(primitives, 0, hits->primitive);
}

// Pushes the frustum's children as distance << 32 | node * 16 + slot, the nearest last.
INLINE uint push_slots(ulong* stack, uint size, BvhView bvh, uint node, NodeHits hits) {
    __global const uint* children = bvh_children(bvh_node(bvh, node));
    float near[BVH_WIDTH] __attribute__((aligned(64)));
    *(float16*)near = hits.near;
    const uint first = size;
    for (uint bits = hits.bits; bits; bits &= bits - 1) {
        const uint slot = lowest_bit(bits);
        bvh_prefetch(bvh, children[slot]);
        const ulong entry = stack_entry(near[slot], node * BVH_WIDTH + slot);
        uint i = size++;
        for (; i > first && stack[i - 1] < entry; i--) stack[i] = stack[i - 1];
        stack[i] = entry;
    }
    return size;
}

    // A block of triangles is tested triangle by triangle where more rays than these meet its box,
    // and ray by ray otherwise. A triangle costs two vectors of 8 rays, or one of 16, and a ray one
    // of 8 triangles, of which six or so are there.
    #define PACKET_FEW_RAYS (ONDE_AVX512 ? 6 : 12)

// What a leaf's primitives are to the rays that meet its box.
INLINE void meet_leaf16(BvhView bvh, uint word, const StreamRays* stream, Packet rays, BoxHits box,
                        const float* t_min, StreamHits* hits) {
    const uint bits = bits16(box.lanes);
    if ((word & BVH_KIND_MASK) == BVH_LEAF_TRIANGLES && popcount(bits) > PACKET_FEW_RAYS) {
        meet_triangles(bvh_block(bvh, word), rays, box, hits);
        return;
    }
    float near[STREAM_WIDTH] __attribute__((aligned(64)));
    *(float16*)near = box.near;
    meet_leaf(bvh, word, stream, t_min, near, BVH_NONE, hits, bits);
}

// Traversals the tree with the rays in `lanes`, which share an octant.
INLINE void traverse_octant(BvhView bvh, const StreamRays* stream, Packet rays, const float* t_min,
                            int16 lanes, uint octant, StreamHits* hits) {
    const Frustum frustum = make_frustum(rays, lanes, octant);
    float t_max = highest_in(vload16(0, hits->t), lanes);
    if (bvh.root & BVH_LEAF) {
        const BoxHits everything = {rays.t_min, lanes};
        meet_leaf16(bvh, bvh.root, stream, rays, everything, t_min, hits);
        return;
    }
    ulong stack[ONDE_STACK_SIZE];
    uint size = push_slots(stack, 0, bvh, bvh.root,
                           frustum_meets_node(bvh_node(bvh, bvh.root), frustum, t_max));
    while (size > 0) {
        const ulong entry = stack[--size];
        if (entry_distance(entry) > t_max) continue;
        const uint slot = (uint)entry % BVH_WIDTH;
        __global const uchar* parent = bvh_node(bvh, (uint)entry / BVH_WIDTH);
        BoxHits box =
            rays_meet_box((__global const float*)parent + slot, frustum, rays, vload16(0, hits->t));
        box.lanes &= lanes;
        if (!bits16(box.lanes)) continue;
        const uint word = bvh_children(parent)[slot];
        if (word & BVH_LEAF) {
            meet_leaf16(bvh, word, stream, rays, box, t_min, hits);
            t_max = highest_in(vload16(0, hits->t), lanes);
        } else {
            size = push_slots(stack, size, bvh, word,
                              frustum_meets_node(bvh_node(bvh, word), frustum, t_max));
        }
    }
}

// As bvh_closest_stream.
OUTLINED void bvh_closest_packet(BVH_SCALARS, StreamRays* rays, const float* t_min,
                                 StreamHits* hits, uint bits) {
    const BvhView bvh = BVH_FROM_SCALARS;
    const Packet packet = load_packet(rays, t_min);
    const int16 asked = finite_rays(packet) & lanes_of(bits);
    const uint16 octant_of = octants(packet);
    uint octant_list[16];
    vstore16(octant_of, 0, octant_list);
    for (uint rest = bits16(asked); rest;) {
        const uint octant = octant_list[lowest_bit(rest)];
        const int16 lanes = (octant_of == (uint16)(octant)) & asked;
        traverse_octant(bvh, rays, packet, t_min, lanes, octant, hits);
        rest &= ~bits16(lanes);
    }
}

#endif

#endif
