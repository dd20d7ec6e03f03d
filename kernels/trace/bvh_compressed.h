// The compressed tree, traversed by one ray: the eight boxes of a node at once, children in the
// order of the ray's signs (Ylitie, Karras and Laine, "Efficient incoherent ray traversal on GPUs
// through compressed wide BVHs", 2017).
#ifndef ONDE_TRACE_BVH_COMPRESSED_H
#define ONDE_TRACE_BVH_COMPRESSED_H

#include "trace/bvh_slot.h"

// Children of one node that a ray has still to visit. Inner ones: `base` is the first's index; bits
// 24 to 31 are those that it meets, by the order of its visit, bits 0 to 7 the slots that hold
// nodes. Or leaves: `base` is the first BvhSlot's index, bits 0 to 23 are those to test.
typedef struct {
    uint base, bits;
} NodeGroup;

#define FIRST_IN_ORDER 24
#define ORDER_MASK 0xff000000u

// Below everything that an instance's tree pushes.
INLINE NodeGroup leave_instance(void) {
    const NodeGroup group = {BVH_NONE, 0};
    return group;
}
// As if it were the only child of a node.
INLINE NodeGroup root_group(uint root) {
    const NodeGroup group = {root, 1u << FIRST_IN_ORDER};
    return group;
}

// A bit of an axis is set where the ray runs toward its low end.
INLINE uint ray_signs(SlabRay ray) {
    return (ray.inverse.x < 0.0f) | (ray.inverse.y < 0.0f) << 1 | (ray.inverse.z < 0.0f) << 2;
}

// Takes the child to visit next out of a group; its index.
INLINE uint take_nearest(NodeGroup* group, uint signs) {
    const uint order = lowest_bit(group->bits >> FIRST_IN_ORDER);
    const uint slot = order ^ signs;
    group->bits &= ~(1u << (FIRST_IN_ORDER + order));
    return group->base + popcount(group->bits & ((1u << slot) - 1));
}

INLINE float8 row_distance(__global const uchar8* rows, uint row, float inverse, float start) {
    return fma(convert_float8(rows[row]), (float8)(inverse), (float8)(start));
}

// The children of a node that the ray meets: nodes, and slots of leaves.
typedef struct {
    NodeGroup nodes, slots;
} NodeVisit;

INLINE NodeVisit visit_node(BvhView bvh, uint index, SlabRay ray, uint signs, float t_min,
                            float t_max) {
    __global const BvhCompressed* node = (__global const BvhCompressed*)bvh.nodes + index;
    __global const uchar8* rows = (__global const uchar8*)node->low_x;
    // A step along the ray, and where it crosses the node's origin planes.
    const float3 step =
        (float3)(as_float((uint)node->exponent[0] << 23), as_float((uint)node->exponent[1] << 23),
                 as_float((uint)node->exponent[2] << 23)) *
        ray.inverse;
    const float3 corner = (float3)(node->origin[0], node->origin[1], node->origin[2]);
    const float3 near = fma(corner, ray.inverse, ray.near);
    const float3 far = fma(corner, ray.inverse, ray.far);
    const uint3 first = ray.plane / 64; // rows of this layout are as many as of the wide one
    const float8 near_x = row_distance(rows, first.x, step.x, near.x);
    const float8 near_y = row_distance(rows, first.y, step.y, near.y);
    const float8 near_z = row_distance(rows, first.z, step.z, near.z);
    const float8 far_x = row_distance(rows, first.x ^ 1, step.x, far.x);
    const float8 far_y = row_distance(rows, first.y ^ 1, step.y, far.y);
    const float8 far_z = row_distance(rows, first.z ^ 1, step.z, far.z);
    const float8 near_xy = max_fast(near_x, near_y), near_zt = max_fast(near_z, (float8)(t_min));
    const float8 far_xy = min_fast(far_x, far_y), far_zt = min_fast(far_z, (float8)(t_max));
    const uint met = bits8(max_fast(near_xy, near_zt) <= min_fast(far_xy, far_zt));

    NodeVisit visit = {{node->child, node->inner}, {node->slot, 0}};
    for (uint bits = met & node->inner; bits; bits &= bits - 1)
        visit.nodes.bits |= 1u << (FIRST_IN_ORDER + (lowest_bit(bits) ^ signs));
    for (uint bits = met & ~(uint)node->inner; bits; bits &= bits - 1) {
        const uint leaf = node->leaf[lowest_bit(bits)];
        visit.slots.bits |= ((1u << (leaf >> 5)) - 1) << (leaf & 31);
    }
    return visit;
}

#if ONDE_TRAVERSAL_COST
INLINE uint count_children(BvhView bvh, uint index) {
    __global const BvhCompressed* node = (__global const BvhCompressed*)bvh.nodes + index;
    return popcount((uint)node->inner) +
           popcount(bits8(convert_int8(*(__global const uchar8*)node->leaf) != 0));
}
#endif

// Where a traversal stands: what it does next, and the ray in the space of the tree that it is in.
typedef struct {
    NodeGroup nodes, slots;
    uint size; // of the stack
    uint signs;
    PlacedRay ray;
} CompressedTraversal;

INLINE uint has_nodes(NodeGroup group) {
    return group.bits >> FIRST_IN_ORDER;
}

INLINE void place_traversal(CompressedTraversal* traversal, PlacedRay ray) {
    traversal->ray = ray;
    traversal->signs = ray_signs(ray.slab);
}
INLINE CompressedTraversal start_traversal(BvhView bvh, PlacedRay ray) {
    CompressedTraversal traversal = {root_group(bvh.root), {0, 0}, 0};
    place_traversal(&traversal, ray);
    return traversal;
}

// Visits the nearest node of the group; its index.
INLINE uint visit_nearest(CompressedTraversal* traversal, NodeGroup* stack, BvhView bvh,
                          float t_max) {
    const uint index = take_nearest(&traversal->nodes, traversal->signs);
    if (has_nodes(traversal->nodes)) stack[traversal->size++] = traversal->nodes;
    const NodeVisit visit =
        visit_node(bvh, index, traversal->ray.slab, traversal->signs, traversal->ray.entry, t_max);
    traversal->nodes = visit.nodes;
    traversal->slots = visit.slots;
    return index;
}

INLINE __global const BvhSlot* take_slot(CompressedTraversal* traversal, BvhView bvh) {
    const uint bit = lowest_bit(traversal->slots.bits);
    traversal->slots.bits &= traversal->slots.bits - 1;
    return bvh_slot(bvh, traversal->slots.base + bit);
}

// Interleaved to an instance's tree; the rest of this one waits.
INLINE void enter_instance(CompressedTraversal* traversal, NodeGroup* stack, BvhView bvh,
                           uint instance, PlacedRay start) {
    if (has_nodes(traversal->nodes)) stack[traversal->size++] = traversal->nodes;
    if (traversal->slots.bits) stack[traversal->size++] = traversal->slots;
    stack[traversal->size++] = leave_instance();
    place_traversal(traversal, place_in_instance(bvh, instance, start.origin, start.direction,
                                                 start.entry TIME(start.time)));
    traversal->nodes = root_group(bvh.instances[instance].root);
    traversal->slots.bits = 0;
}

// Takes from the stack when nothing is left to do; whether there is something then.
INLINE uint find_work(CompressedTraversal* traversal, const NodeGroup* stack, PlacedRay start) {
    while (!has_nodes(traversal->nodes) && !traversal->slots.bits) {
        if (traversal->size == 0) return 0;
        const NodeGroup group = stack[--traversal->size];
        if (group.base == BVH_NONE)
            place_traversal(traversal, start);
        else if (has_nodes(group))
            traversal->nodes = group;
        else
            traversal->slots = group;
    }
    return 1;
}

OUTLINED Hit traverse_closest(BVH_SCALARS, float3 origin, float t_min, float3 direction,
                              float t_max TIME_PARAMETER PASSED_PARAMETERS) {
    const BvhView bvh = BVH_FROM_SCALARS;
    Hit hit = {t_max, 0.0f, 0.0f, BVH_NONE, BVH_NONE};
    PASS_IN(hit);
    if (!is_finite_ray(origin, direction)) return hit;
    NodeGroup stack[ONDE_STACK_SIZE];
    DECLARE_COUNTERS
    const PlacedRay start = place_ray(origin, direction, ENTRY_BEHIND(t_min), BVH_NONE TIME(time));
    CompressedTraversal traversal = start_traversal(bvh, start);
    do {
        if (!traversal.slots.bits) {
            const uint index = visit_nearest(&traversal, stack, bvh, hit.t);
            COUNT_TESTS(boxes, count_children(bvh, index));
            (void)index;
        }
        while (traversal.slots.bits) {
            __global const BvhSlot* slot = take_slot(&traversal, bvh);
#if ONDE_INSTANCES
            if (slot->kind == BVH_LEAF_INSTANCE) {
                enter_instance(&traversal, stack, bvh, slot->primitive, start);
                break;
            }
#endif
            COUNT_TESTS(primitives, 1);
            hit = closest_in_slot(bvh, slot, traversal.ray, t_min, t_min, hit);
        }
    } while (find_work(&traversal, stack, start));
    STORE_COUNTERS(hit)
    return hit;
}

OUTLINED uint traverse_occluded(BVH_SCALARS, float3 origin, float t_min, float3 direction,
                                float t_max TIME_PARAMETER) {
    const BvhView bvh = BVH_FROM_SCALARS;
    if (!is_finite_ray(origin, direction)) return 0;
    NodeGroup stack[ONDE_STACK_SIZE];
    const PlacedRay start = place_ray(origin, direction, t_min, BVH_NONE TIME(time));
    CompressedTraversal traversal = start_traversal(bvh, start);
    do {
        if (!traversal.slots.bits) visit_nearest(&traversal, stack, bvh, t_max);
        while (traversal.slots.bits) {
            __global const BvhSlot* slot = take_slot(&traversal, bvh);
#if ONDE_INSTANCES
            if (slot->kind == BVH_LEAF_INSTANCE) {
                enter_instance(&traversal, stack, bvh, slot->primitive, start);
                break;
            }
#endif
            if (any_in_slot(bvh, slot, traversal.ray, t_min, t_max)) return 1;
        }
    } while (find_work(&traversal, stack, start));
    return 0;
}

#endif
