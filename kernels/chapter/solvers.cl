// Rays against triangles, every pair, by each way to solve for the hit: what the solvers' bench
// times. Rays are six columns: origin, direction; `count` is a multiple of 16, which a work item
// takes. Triangles are 9 floats: A, AB, AC. Out: the nearest distance beyond 0, or infinity.
#include "chapter/solve_triangle.h"
#include "shared/items.h"
#include "trace/triangle.h"

INLINE real3 load_column3(__global const float* columns, size_t count, uint i) {
    return make3(load_real(columns + i), load_real(columns + count + i),
                 load_real(columns + 2 * count + i));
}

#define SOLVER_KERNEL(name, hit_of)                                                                \
    __kernel void name(uint count, __global const float* rays, __global const float* triangles,    \
                       uint triangle_count, __global float* nearest) {                             \
        const uint first = get_global_id(0) * SOLVER_ITEMS;                                        \
        if (first >= count) return;                                                                \
        for (uint i = first; i < first + SOLVER_ITEMS; i += ONDE_WIDTH) {                          \
            const real3 origin = load_column3(rays, count, i);                                     \
            const real3 direction = load_column3(rays + 3 * (size_t)count, count, i);              \
            real t = (real)(INFINITY);                                                             \
            for (uint k = 0; k < triangle_count; k++) {                                            \
                __global const float* triangle = triangles + 9 * k;                                \
                const PlaneHit hit = hit_of(origin, direction, uniform3(triangle),                 \
                                            uniform3(triangle + 3), uniform3(triangle + 6));       \
                t = choose(hit.in_triangle & (hit.t > 0.0f) & (hit.t < t), hit.t, t);              \
            }                                                                                      \
            store_real(nearest + i, t);                                                            \
        }                                                                                          \
    }

SOLVER_KERNEL(inverse, triangle_by_inverse)
SOLVER_KERNEL(gauss, triangle_by_gauss)
SOLVER_KERNEL(cramer, triangle_by_cramer)

INLINE Vectors16 column_vectors16(__global const float* columns, size_t count, uint i) {
    const Vectors16 v = {vload16(0, columns + i), vload16(0, columns + count + i),
                         vload16(0, columns + 2 * count + i)};
    return v;
}
INLINE Vectors16 uniform_vectors16(__global const float* v) {
    const Vectors16 all = {(real16)(v[0]), (real16)(v[1]), (real16)(v[2])};
    return all;
}

// The renderer's test of 16 rays; it divides only where there is a hit.
__kernel void production(uint count, __global const float* rays, __global const float* triangles,
                         uint triangle_count, __global float* nearest) {
    const uint i = get_global_id(0) * SOLVER_ITEMS;
    if (i >= count) return;
    const Vectors16 origin = column_vectors16(rays, count, i);
    const Vectors16 direction = column_vectors16(rays + 3 * (size_t)count, count, i);
    real16 nearest_t = INFINITY;
    for (uint k = 0; k < triangle_count; k++) {
        __global const float* triangle = triangles + 9 * k;
        const TriangleTest16 test =
            test_triangles16(origin, direction, uniform_vectors16(triangle),
                             uniform_vectors16(triangle + 3), uniform_vectors16(triangle + 6));
        if (sign_bits16(test.outside) == 0xffffu) continue;
        const real16 t = test.t / test.determinant;
        nearest_t = ((test.outside >= 0) & (t > 0.0f) & (t < nearest_t)) ? t : nearest_t;
    }
    vstore16(nearest_t, 0, nearest + i);
}
