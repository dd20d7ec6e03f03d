// Vectors of lanes. Short names that say what they do; all componentwise unless said otherwise.
#ifndef ONDE_MATH_VECTOR_H
#define ONDE_MATH_VECTOR_H

#include "math/lanes.h"

typedef struct {
    real x, y;
} real2;
typedef struct {
    real x, y, z;
} real3;

INLINE real2 make2(real x, real y) {
    real2 r;
    r.x = x;
    r.y = y;
    return r;
}
INLINE real3 make3(real x, real y, real z) {
    real3 r;
    r.x = x;
    r.y = y;
    r.z = z;
    return r;
}
INLINE real3 splat3(real a) {
    return make3(a, a, a);
}
INLINE real3 zero3(void) {
    return splat3((real)(0.0f));
}
// The same three numbers in every lane.
INLINE real3 uniform3(__global const float* v) {
    return make3((real)(v[0]), (real)(v[1]), (real)(v[2]));
}

INLINE real3 add3(real3 a, real3 b) {
    return make3(a.x + b.x, a.y + b.y, a.z + b.z);
}
INLINE real3 sub3(real3 a, real3 b) {
    return make3(a.x - b.x, a.y - b.y, a.z - b.z);
}
INLINE real3 mul3(real3 a, real3 b) {
    return make3(a.x * b.x, a.y * b.y, a.z * b.z);
}
INLINE real3 scale3(real3 a, real s) {
    return make3(a.x * s, a.y * s, a.z * s);
}
INLINE real3 negate3(real3 a) {
    return make3(-a.x, -a.y, -a.z);
}
// a * s + b
INLINE real3 madd3(real3 a, real s, real3 b) {
    return make3(fma(a.x, s, b.x), fma(a.y, s, b.y), fma(a.z, s, b.z));
}
// a * b + c
INLINE real3 fma3(real3 a, real3 b, real3 c) {
    return make3(fma(a.x, b.x, c.x), fma(a.y, b.y, c.y), fma(a.z, b.z, c.z));
}
INLINE real dot3(real3 a, real3 b) {
    return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
}
INLINE real3 cross3(real3 a, real3 b) {
    return make3(fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)),
                 fma(a.x, b.y, -(a.y * b.x)));
}
INLINE real length3(real3 a) {
    return sqrt(dot3(a, a));
}
// The zero vector becomes NaN, as in every textbook.
INLINE real3 normalize3(real3 a) {
    return scale3(a, 1.0f / length3(a));
}
INLINE real3 mix3(real3 a, real3 b, real t) {
    return madd3(sub3(b, a), t, a);
}

INLINE real max_component3(real3 a) {
    return max_real(a.x, max_real(a.y, a.z));
}
INLINE real luminance3(real3 a) {
    return fma((real)(0.0722f), a.z, fma((real)(0.7152f), a.y, 0.2126f * a.x));
}
INLINE mask nonzero3(real3 a) {
    return (a.x != 0.0f) | (a.y != 0.0f) | (a.z != 0.0f);
}

OVERLOAD real2 choose(mask m, real2 a, real2 b) {
    return make2(choose(m, a.x, b.x), choose(m, a.y, b.y));
}
OVERLOAD real3 choose(mask m, real3 a, real3 b) {
    return make3(choose(m, a.x, b.x), choose(m, a.y, b.y), choose(m, a.z, b.z));
}

#define RECORD3(records, i, Type, field)                                                           \
    make3(RECORD(records, i, Type, field[0]), RECORD(records, i, Type, field[1]),                  \
          RECORD(records, i, Type, field[2]))

// An orthonormal basis around n, which is its third axis.
typedef struct {
    real3 s, t, n;
} Basis;

// Duff et al. 2017, Building an Orthonormal Basis, Revisited.
INLINE Basis make_basis(real3 n) {
    const real sign = choose(n.z >= 0.0f, (real)(1.0f), (real)(-1.0f));
    const real a = -1.0f / (sign + n.z);
    const real b = n.x * n.y * a;
    Basis basis;
    basis.s = make3(fma(sign * n.x, n.x * a, (real)(1.0f)), sign * b, -sign * n.x);
    basis.t = make3(b, fma(n.y, n.y * a, sign), -n.y);
    basis.n = n;
    return basis;
}
// The same whose first axis lies as near a direction as it can; any where there is no nearest.
INLINE Basis make_basis_along(real3 n, real3 direction) {
    Basis basis = make_basis(n);
    const real3 s = madd3(n, -dot3(n, direction), direction);
    const real length = length3(s);
    const mask usable = length > 1e-4f;
    const real3 along = scale3(s, 1.0f / max_real(length, (real)(1e-20f)));
    basis.t = choose(usable, cross3(n, along), basis.t);
    basis.s = choose(usable, along, basis.s);
    return basis;
}
INLINE real3 to_local(Basis b, real3 v) {
    return make3(dot3(b.s, v), dot3(b.t, v), dot3(b.n, v));
}
INLINE real3 to_world(Basis b, real3 v) {
    return madd3(b.n, v.z, madd3(b.t, v.y, scale3(b.s, v.x)));
}

#endif
