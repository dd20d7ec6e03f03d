// What every traversal shares, whatever the layout of the BVH: the view of its arrays, the ray in
// the space of the BVH that it traverses, entries of the stack.
#ifndef ONDE_TRACE_BVH_VIEW_H
#define ONDE_TRACE_BVH_VIEW_H

#include "trace/bvh_leaf.h"
#include "trace/bvh_slab.h"
#include "trace/moving.h"

// Entries that the tree's deepest traversal needs: Bvh::stack_size.
#ifndef ONDE_STACK_SIZE
    #define ONDE_STACK_SIZE 256
#endif
// Whether some leaf of the tree is an instance, or a sphere; the code for it is left out otherwise.
#ifndef ONDE_INSTANCES
    #define ONDE_INSTANCES 1
#endif
#ifndef ONDE_SPHERES
    #define ONDE_SPHERES 1
#endif
// Whether some leaf is an analytic shape; those hang in instances only.
#ifndef ONDE_SHAPES
    #define ONDE_SHAPES ONDE_INSTANCES
#endif

#define BVH_MEMBER(Type, name, words) __global const Type* name;
typedef struct {
    BVH_BUFFERS(BVH_MEMBER)
    uint root; // child word
#if ONDE_SHUTTER
    real time; // of the rays that lanes ask about, in [0, 1) of the shutter
#endif
} BvhView;

INLINE uint is_finite_ray(float3 origin, float3 direction) {
    const float3 sum = (origin + direction) * 0.0f; // NaN where there was NaN or infinity
    return sum.x + sum.y + sum.z == 0.0f;
}

// What waits on the stack of a closest-hit traversal: distance << 32 | child word. Positive floats
// order like their bits, so one integer comparison sorts by distance.
INLINE ulong stack_entry(float distance, uint word) {
    return (ulong)as_uint(distance) << 32 | word;
}
INLINE float entry_distance(ulong entry) {
    return as_float((uint)(entry >> 32));
}

// Waits below everything an instance's tree pushes; no tree has this child word.
#define STACK_LEAVE_INSTANCE ((ulong)BVH_NONE)

// The view as single parameters: of kernels, and of functions that are not inlined, where a struct
// would go through memory, which a short traversal feels.
#define BVH_SCALAR(Type, name, words) __global const Type *name,
#define BVH_SCALARS BVH_BUFFERS(BVH_SCALAR) uint root
#define BVH_TO_SCALARS(bvh) bvh.nodes, bvh.blocks, bvh.spheres, bvh.instances, bvh.root
#define BVH_NAME(Type, name, words) name,
#define BVH_FROM_SCALARS                                                                           \
    { BVH_BUFFERS(BVH_NAME) root }

// The hit that a ray has passed as parameters of a traversal, which are there where rays pass
// anything; and the distance before which no box needs to be entered, less some rounding.
#if ONDE_PASSING
    #define PASSED_PARAMETERS , float passed_t, uint passed_primitive, uint passed_instance
    #define PASSED_NOTHING , 0.0f, 0, 0
    #define PASS_IN(hit)                                                                           \
        hit.passed.t = passed_t;                                                                   \
        hit.passed.primitive = passed_primitive;                                                   \
        hit.passed.instance = passed_instance
    #define ENTRY_BEHIND(t_min) max_fast(t_min, passed_t*(1.0f - 4e-6f))
#else
    #define PASSED_PARAMETERS
    #define PASSED_NOTHING
    #define PASS_IN(hit)
    #define ENTRY_BEHIND(t_min) t_min
#endif

// A ray in the space of the tree that it traverses.
typedef struct {
    float3 origin, direction;
    SlabRay slab;
    float entry;   // no box of the tree is entered earlier
    uint instance; // that the tree is of; BVH_NONE: the world's
#if ONDE_SHUTTER
    float time;
#endif
} PlacedRay;

INLINE PlacedRay place_ray(float3 origin, float3 direction, float entry,
                           uint instance TIME_PARAMETER) {
    const PlacedRay ray = {origin, direction, make_slab_ray(origin, direction), entry,
                           instance TIME(time)};
    return ray;
}
INLINE PlacedRay place_in_instance(BvhView bvh, uint instance, float3 origin, float3 direction,
                                   float entry TIME_PARAMETER) {
#if ONDE_SHUTTER
    if (bvh.instances[instance].steps > 0) {
        const MovedInstance moved = moved_instance(bvh.instances, instance, time);
        return place_ray(moved_point(moved, origin), moved_vector(moved, direction), entry,
                         instance, time);
    }
#endif
    __global const float* rows = bvh.instances[instance].world_to_object;
    return place_ray(transform_point(rows, origin), transform_vector(rows, direction), entry,
                     instance TIME(time));
}

#endif
