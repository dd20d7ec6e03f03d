// Probes of the chapter's linear systems, and of rays against triangles by each of them.
#include "chapter/solve_triangle.h"
#include "probe/probe.h"

// In: columns a, b, c (9), right (3). Out, for inverse, Gauss and Cramer: x (3), regular.
PROBE(solve) {
    const Matrix3 m = matrix3(input3(items, 0), input3(items, 3), input3(items, 6));
    const real3 right = input3(items, 9);
    const Solution3 by_inverse = solve_inverse(m, right), by_gauss = solve_gauss(m, right);
    const Solution3 by_cramer = solve_cramer(m, right);
    output(items, 0, by_inverse.x);
    output_mask(items, 3, by_inverse.regular);
    output(items, 4, by_gauss.x);
    output_mask(items, 7, by_gauss.regular);
    output(items, 8, by_cramer.x);
    output_mask(items, 11, by_cramer.regular);
}

// In: columns a, b, c (9). Out: the determinant.
PROBE(determinant) {
    output(items, 0, triple_product(input3(items, 0), input3(items, 3), input3(items, 6)));
}

INLINE void output_hit(Items items, uint k, PlaneHit hit) {
    output(items, k, hit.t);
    output(items, k + 1, hit.u);
    output(items, k + 2, hit.v);
    output_mask(items, k + 3, hit.in_parallelogram);
    output_mask(items, k + 4, hit.in_triangle);
}

// In: origin (3), direction (3), A (3), AB (3), AC (3). Out, for each solver: t, u, v, whether in
// the parallelogram, whether in the triangle.
PROBE(solve_triangle) {
    const real3 origin = input3(items, 0), direction = input3(items, 3);
    const real3 a = input3(items, 6), ab = input3(items, 9), ac = input3(items, 12);
    output_hit(items, 0, triangle_by_inverse(origin, direction, a, ab, ac));
    output_hit(items, 5, triangle_by_gauss(origin, direction, a, ab, ac));
    output_hit(items, 10, triangle_by_cramer(origin, direction, a, ab, ac));
}
