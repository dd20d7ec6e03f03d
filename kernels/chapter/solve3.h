// Three linear equations in three unknowns, solved the chapter's three ways (C11): by the inverse
// matrix, by Gaussian elimination, by Cramer's rule. Each says which systems are singular and
// divides by nothing there.
#ifndef ONDE_CHAPTER_SOLVE3_H
#define ONDE_CHAPTER_SOLVE3_H

#include "math/vector.h"

// The columns of a matrix: a x + b y + c z = right.
typedef struct {
    real3 a, b, c;
} Matrix3;

// x holds where the system is regular, and is zero elsewhere.
typedef struct {
    real3 x;
    mask regular;
} Solution3;

// A determinant this close to zero, in proportion to the sum of the magnitudes of its six products,
// is no more than its own rounding error.
#define SINGULAR 4e-7f

INLINE Matrix3 matrix3(real3 a, real3 b, real3 c) {
    Matrix3 m;
    m.a = a;
    m.b = b;
    m.c = c;
    return m;
}
INLINE real3 abs3(real3 v) {
    return make3(fabs(v.x), fabs(v.y), fabs(v.z));
}
// a . (b x c)
INLINE real triple_product(real3 a, real3 b, real3 c) {
    return dot3(a, cross3(b, c));
}
// The same with all six products positive.
INLINE real permanent(Matrix3 m) {
    const real3 a = abs3(m.a), b = abs3(m.b), c = abs3(m.c);
    return dot3(
        a, make3(fma(b.y, c.z, b.z * c.y), fma(b.z, c.x, b.x * c.z), fma(b.x, c.y, b.y * c.x)));
}
// Written so that NaN is singular.
INLINE mask is_regular(Matrix3 m, real determinant) {
    return fabs(determinant) > SINGULAR * permanent(m);
}
INLINE Solution3 solution3(real3 x, mask regular) {
    Solution3 solution;
    solution.x = choose(regular, x, zero3());
    solution.regular = regular;
    return solution;
}

// The inverse by its adjugate, whose rows are cross products of columns; then one product.
INLINE Solution3 solve_inverse(Matrix3 m, real3 right) {
    const real3 bc = cross3(m.b, m.c), ca = cross3(m.c, m.a), ab = cross3(m.a, m.b);
    const real determinant = dot3(m.a, bc);
    const mask regular = is_regular(m, determinant);
    const real inverse = 1.0f / choose(regular, determinant, (real)(1.0f));
    const real3 row_x = scale3(bc, inverse), row_y = scale3(ca, inverse);
    const real3 row_z = scale3(ab, inverse);
    return solution3(make3(dot3(row_x, right), dot3(row_y, right), dot3(row_z, right)), regular);
}

// An equation of the system: coefficients of x, y, z and the right side.
typedef struct {
    real x, y, z, right;
} Equation;

INLINE Equation equation(real x, real y, real z, real right) {
    Equation e;
    e.x = x;
    e.y = y;
    e.z = z;
    e.right = right;
    return e;
}
OVERLOAD Equation choose(mask m, Equation a, Equation b) {
    return equation(choose(m, a.x, b.x), choose(m, a.y, b.y), choose(m, a.z, b.z),
                    choose(m, a.right, b.right));
}
// e - factor * pivot
INLINE Equation eliminate(Equation e, real factor, Equation pivot) {
    return equation(fma(-factor, pivot.x, e.x), fma(-factor, pivot.y, e.y),
                    fma(-factor, pivot.z, e.z), fma(-factor, pivot.right, e.right));
}
INLINE void swap_if(mask m, Equation* a, Equation* b) {
    const Equation first = choose(m, *b, *a);
    *b = choose(m, *a, *b);
    *a = first;
}
INLINE real nonzero_or_one(real a) {
    return choose(a != 0.0f, a, (real)(1.0f));
}

// Elimination with partial pivoting: the largest coefficient of each column is brought up before it
// is divided by. The determinant is, but for its sign, the product of the pivots.
INLINE Solution3 solve_gauss(Matrix3 m, real3 right) {
    Equation first = equation(m.a.x, m.b.x, m.c.x, right.x);
    Equation second = equation(m.a.y, m.b.y, m.c.y, right.y);
    Equation third = equation(m.a.z, m.b.z, m.c.z, right.z);
    swap_if(fabs(second.x) > fabs(first.x), &first, &second);
    swap_if(fabs(third.x) > fabs(first.x), &first, &third);
    const real pivot_x = nonzero_or_one(first.x);
    second = eliminate(second, second.x / pivot_x, first);
    third = eliminate(third, third.x / pivot_x, first);
    swap_if(fabs(third.y) > fabs(second.y), &second, &third);
    const real pivot_y = nonzero_or_one(second.y);
    third = eliminate(third, third.y / pivot_y, second);

    const mask regular = is_regular(m, first.x * second.y * third.z);
    const real z = third.right / nonzero_or_one(third.z);
    const real y = fma(-second.z, z, second.right) / pivot_y;
    const real x = fma(-first.z, z, fma(-first.y, y, first.right)) / pivot_x;
    return solution3(make3(x, y, z), regular);
}

// Each unknown is the determinant of the matrix with its column replaced by the right side, over
// that of the matrix; determinants are triple products.
INLINE Solution3 solve_cramer(Matrix3 m, real3 right) {
    const real determinant = triple_product(m.a, m.b, m.c);
    const mask regular = is_regular(m, determinant);
    const real inverse = 1.0f / choose(regular, determinant, (real)(1.0f));
    const real3 replaced = make3(triple_product(right, m.b, m.c), triple_product(m.a, right, m.c),
                                 triple_product(m.a, m.b, right));
    return solution3(scale3(replaced, inverse), regular);
}

#endif
