// The tree, traversed by a ray stream of 16 or 32, whatever their directions: each entry of the
// stack is a child and the rays that meet its box. A node is read once for all of them; rays test
// it one after the other, without a branch in between, so that the processor overlaps their work
// and mispredicts once a node instead of once a ray. After Barringer and Akenine-Moeller, "Dynamic
// ray stream traversal", 2014. Answers are those of the traversals in bvh.h, bit for bit.
#ifndef ONDE_TRACE_BVH_STREAM_H
#define ONDE_TRACE_BVH_STREAM_H

#include "trace/bvh_wide.h"

#define STREAM_WIDTH 16
// Shadow rays, whose order does not matter, gain 6 % from a second half.
#define OCCLUDED_WIDTH 32

// Rows by ray, of which the second half may be idle. `inverse`, `near`, `far` and `plane` as in
// SlabRay.
typedef struct {
    float origin[3][OCCLUDED_WIDTH], direction[3][OCCLUDED_WIDTH];
    float inverse[3][OCCLUDED_WIDTH], near[3][OCCLUDED_WIDTH], far[3][OCCLUDED_WIDTH];
    uint plane[3][OCCLUDED_WIDTH];
#if ONDE_SHUTTER
    float time[OCCLUDED_WIDTH];
#endif
} StreamRays;

// Rays that nobody asks about, so that arithmetic on places that stay empty is on numbers.
INLINE void clear_first_half(StreamRays* rays) {
    for (uint axis = 0; axis < 3; axis++) {
        vstore16((real16)(0.0f), 0, rays->origin[axis]);
        vstore16((real16)(0.0f), 0, rays->direction[axis]);
    }
#if ONDE_SHUTTER
    vstore16((real16)(0.0f), 0, rays->time);
#endif
}

// The halves that hold the rays in `bits`.
INLINE uint stream_halves(uint bits) {
    return bits >> STREAM_WIDTH ? 2 : 1;
}

INLINE void prepare_axis(StreamRays* rays, uint axis, uint part, real16 reach) {
    const SlabAxis16 slab = make_slab_axis16(vload16(part, rays->origin[axis]),
                                             vload16(part, rays->direction[axis]), reach);
    vstore16(slab.inverse, part, rays->inverse[axis]);
    vstore16(slab.near, part, rays->near[axis]);
    vstore16(slab.far, part, rays->far[axis]);
    const mask16 low = (mask16)((int)(128 * axis)), high = (mask16)((int)(128 * axis + 64));
    vstore16(as_natural16(slab.inverse < 0.0f ? high : low), part, rays->plane[axis]);
}

// Fills in all that follows from origin and direction.
INLINE void prepare_stream(StreamRays* rays, uint halves) {
    for (uint i = 0; i < halves; i++) {
        const real16 reach = watertight_reach16(
            vload16(i, rays->origin[0]), vload16(i, rays->origin[1]), vload16(i, rays->origin[2]));
        prepare_axis(rays, 0, i, reach);
        prepare_axis(rays, 1, i, reach);
        prepare_axis(rays, 2, i, reach);
    }
}

INLINE float3 stream_origin(const StreamRays* rays, uint r) {
    return (float3)(rays->origin[0][r], rays->origin[1][r], rays->origin[2][r]);
}
INLINE float3 stream_direction(const StreamRays* rays, uint r) {
    return (float3)(rays->direction[0][r], rays->direction[1][r], rays->direction[2][r]);
}

INLINE void set_axis(StreamRays* rays, uint axis, uint r, float origin, float direction,
                     float inverse, float near, float far, uint plane) {
    rays->origin[axis][r] = origin;
    rays->direction[axis][r] = direction;
    rays->inverse[axis][r] = inverse;
    rays->near[axis][r] = near;
    rays->far[axis][r] = far;
    rays->plane[axis][r] = plane;
}

INLINE uint finite_stream(const StreamRays* rays, uint halves) {
    uint finite = 0;
    for (uint i = 0; i < halves; i++) {
        real16 sum = 0.0f;
        for (uint axis = 0; axis < 3; axis++)
            sum += (vload16(i, rays->origin[axis]) + vload16(i, rays->direction[axis])) * 0.0f;
        finite |= bits16(sum == 0.0f) << STREAM_WIDTH * i;
    }
    return finite;
}

INLINE SlabRay stream_slab(const StreamRays* rays, uint r) {
    SlabRay slab;
    slab.inverse = (float3)(rays->inverse[0][r], rays->inverse[1][r], rays->inverse[2][r]);
    slab.near = (float3)(rays->near[0][r], rays->near[1][r], rays->near[2][r]);
    slab.far = (float3)(rays->far[0][r], rays->far[1][r], rays->far[2][r]);
    slab.plane = (uint3)(rays->plane[0][r], rays->plane[1][r], rays->plane[2][r]);
    return slab;
}

#if ONDE_INSTANCES
// Puts a ray that is placed into place r.
INLINE void set_stream_ray(StreamRays* rays, uint r, PlacedRay ray) {
    const float3 origin = ray.origin, direction = ray.direction;
    const SlabRay slab = ray.slab;
    set_axis(rays, 0, r, origin.x, direction.x, slab.inverse.x, slab.near.x, slab.far.x,
             slab.plane.x);
    set_axis(rays, 1, r, origin.y, direction.y, slab.inverse.y, slab.near.y, slab.far.y,
             slab.plane.y);
    set_axis(rays, 2, r, origin.z, direction.z, slab.inverse.z, slab.near.z, slab.far.z,
             slab.plane.z);
}
INLINE void copy_stream_ray(StreamRays* to, const StreamRays* from, uint r) {
    for (uint axis = 0; axis < 3; axis++)
        set_axis(to, axis, r, from->origin[axis][r], from->direction[axis][r],
                 from->inverse[axis][r], from->near[axis][r], from->far[axis][r],
                 from->plane[axis][r]);
}

    #if ONDE_SHUTTER
// The rays in the space of an instance that moves, each at its moment.
INLINE void place_in_moving(StreamRays* inside, const StreamRays* world, BvhView bvh, uint instance,
                            uint halves) {
    for (uint r = 0; r < STREAM_WIDTH * halves; r++) {
        const MovedInstance moved = moved_instance(bvh.instances, instance, world->time[r]);
        const float3 origin = moved_point(moved, stream_origin(world, r));
        const float3 direction = moved_vector(moved, stream_direction(world, r));
        set_axis(inside, 0, r, origin.x, direction.x, 0.0f, 0.0f, 0.0f, 0u);
        set_axis(inside, 1, r, origin.y, direction.y, 0.0f, 0.0f, 0.0f, 0u);
        set_axis(inside, 2, r, origin.z, direction.z, 0.0f, 0.0f, 0.0f, 0u);
    }
}
    #endif

// The rays in the space of an instance.
INLINE void place_stream(StreamRays* inside, const StreamRays* world, BvhView bvh, uint instance,
                         uint halves) {
    #if ONDE_SHUTTER
    if (bvh.instances[instance].steps > 0) {
        place_in_moving(inside, world, bvh, instance, halves);
        prepare_stream(inside, halves);
        return;
    }
    #endif
    for (uint i = 0; i < halves; i++) {
        __global const float* m = bvh.instances[instance].world_to_object;
        const real16 px = vload16(i, world->origin[0]), py = vload16(i, world->origin[1]),
                     pz = vload16(i, world->origin[2]);
        const real16 vx = vload16(i, world->direction[0]), vy = vload16(i, world->direction[1]),
                     vz = vload16(i, world->direction[2]);
        for (uint row = 0; row < 3; row++, m += 4) {
            const real16 a = m[0], b = m[1], c = m[2], d = m[3];
            vstore16(fma(a, px, fma(b, py, fma(c, pz, d))), i, inside->origin[row]);
            vstore16(fma(a, vx, fma(b, vy, c * vz)), i, inside->direction[row]);
        }
    }
    prepare_stream(inside, halves);
}
#endif

// The mask of ray r in lanes that hold a mask of rays each.
INLINE mask16 ray_bit16(uint r) {
    return (mask16)((int)(1u << r));
}

#endif
