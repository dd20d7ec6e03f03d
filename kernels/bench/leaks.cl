// Rays from inside a closed mesh at its shared edges and corners: how many get out. Aims are a
// function of a ray's number alone.
#include "shared/items.h"
#include "trace/bvh.h"

INLINE uint scrambled(uint* state) {
    *state = *state * 747796405u + 2891336453u; // PCG: O'Neill 2014
    const uint word = ((*state >> ((*state >> 28) + 4)) ^ *state) * 277803737u;
    return (word >> 22) ^ word;
}
INLINE float unit_number(uint* state) {
    return (float)(scrambled(state) >> 8) * 0x1p-24f;
}
INLINE float3 in_cube(uint* state) {
    const float x = unit_number(state), y = unit_number(state), z = unit_number(state);
    return (float3)(x, y, z) * 2.0f - 1.0f;
}
INLINE float3 corner_at(__global const float* positions, uint i) {
    return (float3)(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
}

// A corner, or a point on an edge, half and half.
INLINE float3 aim(__global const float* positions, __global const uint* triangles,
                  uint triangle_count, uint* state) {
    const uint i = scrambled(state) % triangle_count, k = scrambled(state) % 3;
    const float3 a = corner_at(positions, triangles[3 * i + k]);
    if (scrambled(state) & 0x10000u) return a;
    const float3 b = corner_at(positions, triangles[3 * i + (k + 1) % 3]);
    return a + unit_number(state) * (b - a);
}

// Origins lie in the box of half size `inside` about the origin.
__kernel void count_leaks(uint count, BVH_SCALARS, __global const float* positions,
                          __global const uint* triangles, uint triangle_count, float inside_x,
                          float inside_y, float inside_z, uint first_item, __global uint* leaks) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const BvhView bvh = BVH_FROM_SCALARS;
    uint state = (first_item + i) * 0x9e3779b9u + 12345u, sum = 0;
    for (uint k = 0; k < LEAK_RAYS; k++) {
        const float3 origin = in_cube(&state) * (float3)(inside_x, inside_y, inside_z);
        const float3 direction = aim(positions, triangles, triangle_count, &state) - origin;
        sum += bvh_closest(bvh, origin, 0.0f, direction, 1e30f).primitive == BVH_NONE;
    }
    leaks[i] = sum;
}
