// A ray against the slots that leaves of the narrow layouts hold: the arithmetic of the wide
// leaves, one primitive at a time.
#ifndef ONDE_TRACE_BVH_SLOT_H
#define ONDE_TRACE_BVH_SLOT_H

#include "trace/bvh_view.h"

INLINE __global const BvhSlot* bvh_slot(BvhView bvh, uint index) {
    return (__global const BvhSlot*)bvh.blocks + index;
}

INLINE Vectors1 slot_vector(__global const float* v) {
    const Vectors1 vector = {v[0], v[1], v[2]};
    return vector;
}
INLINE TriangleTest1 test_slot(__global const BvhSlot* slot, PlacedRay ray) {
    const Vectors1 origin = {ray.origin.x, ray.origin.y, ray.origin.z};
    const Vectors1 direction = {ray.direction.x, ray.direction.y, ray.direction.z};
    return leaf_test1(origin, direction, slot_vector(slot->v0), slot_vector(slot->e1),
                      slot_vector(slot->e2));
}

INLINE Hit closest_on_triangle(__global const BvhSlot* slot, PlacedRay ray, float t_min, float near,
                               Hit hit) {
    const TriangleTest1 test = test_slot(slot, ray);
    if (miss1(test, t_min, hit.t) < 0) return hit;
    const float inverse = 1.0f / test.determinant;
    const float t = test.t * inverse;
    if (!(t > t_min)) return hit;
    const Hit closer = replace_hit(hit, max_fast(t, near), test.u * inverse, test.v * inverse,
                                   slot->primitive, ray.instance);
    return closer.t <= hit.t && is_closer(closer.t, closer.primitive, closer.instance, hit) ? closer
                                                                                            : hit;
}

// `hit`, or the hit of what is in the slot, and no instance, in (t_min, hit.t]; `near` as in
// closest_in_block.
INLINE Hit closest_in_slot(BvhView bvh, __global const BvhSlot* slot, PlacedRay ray, float t_min,
                           float near, Hit hit) {
#if ONDE_SPHERES
    if (slot->kind == BVH_LEAF_SPHERE)
        return closest_on_sphere(bvh.spheres[slot->primitive], ray.origin, t_min, ray.direction,
                                 near, ray.instance, hit);
#endif
#if ONDE_SHAPES
    if (slot->kind == BVH_LEAF_SHAPE)
        return closest_on_shape(bvh.spheres[slot->primitive], ray.origin, t_min, ray.direction,
                                near, ray.instance, hit);
#endif
    return closest_on_triangle(slot, ray, t_min, near, hit);
}

// Whether what is in the slot, and no instance, is hit in (t_min, t_max].
INLINE uint any_in_slot(BvhView bvh, __global const BvhSlot* slot, PlacedRay ray, float t_min,
                        float t_max) {
#if ONDE_SPHERES
    if (slot->kind == BVH_LEAF_SPHERE)
        return sphere_distance(bvh.spheres[slot->primitive], ray.origin, t_min, ray.direction,
                               t_max) != INFINITY;
#endif
#if ONDE_SHAPES
    if (slot->kind == BVH_LEAF_SHAPE)
        return shape_distance(bvh.spheres[slot->primitive], ray.origin, t_min, ray.direction,
                              t_max) != INFINITY;
#endif
    const TriangleTest1 test = test_slot(slot, ray);
    if (miss1(test, t_min, t_max) < 0) return 0;
    const float t = test.t * (1.0f / test.determinant);
    return t > t_min && t <= t_max;
}

#endif
