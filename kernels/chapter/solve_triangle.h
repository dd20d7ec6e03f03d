// A ray against a triangle as the chapter's linear system (C11): S + t v = A + u AB + v AC, solved
// by any of the solvers of solve3.h. The renderer's own test is in triangle.h.
#ifndef ONDE_CHAPTER_SOLVE_TRIANGLE_H
#define ONDE_CHAPTER_SOLVE_TRIANGLE_H

#include "chapter/solve3.h"

typedef struct {
    real t, u, v;          // zero where the ray is parallel to the triangle
    mask in_parallelogram; // 0 <= u <= 1 and 0 <= v <= 1, the chapter's words
    mask in_triangle;      // u >= 0, v >= 0 and u + v <= 1: barycentric (1 - u - v : u : v)
} PlaneHit;

// The system of a ray and a triangle: -v t + AB u + AC v = S - A, unknowns (t, u, v).
INLINE Matrix3 triangle_matrix(real3 direction, real3 ab, real3 ac) {
    return matrix3(negate3(direction), ab, ac);
}

// Anywhere on the ray's line: the sign of t is the caller's to look at.
INLINE PlaneHit plane_hit(Solution3 solution) {
    PlaneHit hit;
    hit.t = solution.x.x;
    hit.u = solution.x.y;
    hit.v = solution.x.z;
    const mask positive = solution.regular & (hit.u >= 0.0f) & (hit.v >= 0.0f);
    hit.in_parallelogram = positive & (hit.u <= 1.0f) & (hit.v <= 1.0f);
    hit.in_triangle = positive & (hit.u + hit.v <= 1.0f);
    return hit;
}

INLINE PlaneHit triangle_by_inverse(real3 origin, real3 direction, real3 a, real3 ab, real3 ac) {
    return plane_hit(solve_inverse(triangle_matrix(direction, ab, ac), sub3(origin, a)));
}
INLINE PlaneHit triangle_by_gauss(real3 origin, real3 direction, real3 a, real3 ab, real3 ac) {
    return plane_hit(solve_gauss(triangle_matrix(direction, ab, ac), sub3(origin, a)));
}
INLINE PlaneHit triangle_by_cramer(real3 origin, real3 direction, real3 a, real3 ab, real3 ac) {
    return plane_hit(solve_cramer(triangle_matrix(direction, ab, ac), sub3(origin, a)));
}

#endif
