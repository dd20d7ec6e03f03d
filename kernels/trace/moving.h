// Where instances are that move while the shutter is open, at a moment of it.
#ifndef ONDE_TRACE_MOVING_H
#define ONDE_TRACE_MOVING_H

#include "math/lanes.h"
#include "shared/bvh.h"
#include "shared/columns.h"

// The moment of a ray, where there are moments: the last but one of a function's parameters, and
// what is given for it.
#if ONDE_SHUTTER
    #define TIME_PARAMETER , float time
    #define TIME(moment) , moment
#else
    #define TIME_PARAMETER
    #define TIME(moment)
#endif

#if ONDE_SHUTTER

// Rows of the 3x4 matrices to the object and back.
typedef struct {
    float3 to_object[3], object_offset;
    float3 to_world[3], world_offset;
} MovedInstance;

// A row of a key, or of the mean of two.
INLINE float4 mixed_row(__global const BvhInstance* from, uint row, float share) {
    const float4 a = vload4(row, from[0].object_to_world), b = vload4(row, from[1].object_to_world);
    return fma((float4)(share), b - a, a);
}

INLINE float3 cross_scalar(float3 a, float3 b) {
    return (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
INLINE float sum_of_products(float3 a, float3 b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

// An instance that moves, at a moment in [0, 1]: its matrix is mixed of the two keys around that,
// and so maps points on straight ways. What is flat just then, all rays miss.
INLINE MovedInstance moved_instance(__global const BvhInstance* instances, uint instance,
                                    float time) {
    const uint steps = instances[instance].steps;
    const float at = time * (float)(steps);
    const uint step = min((uint)at, steps - 1);
    __global const BvhInstance* from = instances + instances[instance].keys + step;
    const float share = at - (float)(step);
    const float4 x = mixed_row(from, 0, share), y = mixed_row(from, 1, share),
                 z = mixed_row(from, 2, share);
    const float3 offset = (float3)(x.w, y.w, z.w);
    const float3 a = cross_scalar(y.xyz, z.xyz), b = cross_scalar(z.xyz, x.xyz),
                 c = cross_scalar(x.xyz, y.xyz);
    const float determinant = sum_of_products(x.xyz, a);
    const float inverse = determinant == 0.0f ? 0.0f : 1.0f / determinant;
    MovedInstance m;
    m.to_world[0] = x.xyz;
    m.to_world[1] = y.xyz;
    m.to_world[2] = z.xyz;
    m.world_offset = offset;
    m.to_object[0] = (float3)(a.x, b.x, c.x) * inverse;
    m.to_object[1] = (float3)(a.y, b.y, c.y) * inverse;
    m.to_object[2] = (float3)(a.z, b.z, c.z) * inverse;
    m.object_offset =
        -(float3)(sum_of_products(m.to_object[0], offset), sum_of_products(m.to_object[1], offset),
                  sum_of_products(m.to_object[2], offset));
    return m;
}

// A vector of the world, and a point, in the space of the object.
INLINE float3 moved_vector(MovedInstance m, float3 v) {
    return (float3)(sum_of_products(m.to_object[0], v), sum_of_products(m.to_object[1], v),
                    sum_of_products(m.to_object[2], v));
}
INLINE float3 moved_point(MovedInstance m, float3 p) {
    return moved_vector(m, p) + m.object_offset;
}

#endif

#endif
