// Rays against triangles: Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection",
// 1997, in three widths with one arithmetic: 8 triangles against a ray, 16 rays against a
// triangle, or one and one. All round alike, lane by lane, so that no answer depends on which of
// them was asked.
//
// The determinants are grouped by the triangle's normal and by the plane that the ray spans with
// corner 0. The distance comes from the normal alone: what rounding does to the normal of a narrow
// triangle then moves a hit by its share of the edges' length, and not of the way to the origin.
#ifndef ONDE_TRACE_TRIANGLE_H
#define ONDE_TRACE_TRIANGLE_H

#include "trace/bvh_bits.h"

// How much the test on undivided values is widened; it must let pass whatever the division accepts.
#define TRIANGLE_SLACK 1e-6f

#define DEFINE_TRIANGLES(N)                                                                        \
    typedef struct {                                                                               \
        float##N x, y, z;                                                                          \
    } Vectors##N;                                                                                  \
                                                                                                   \
    /* The solution times the determinant, which is not negative; the division comes later. */     \
    typedef struct {                                                                               \
        float##N determinant, t, u, v;                                                             \
        int##N outside; /* the sign is set unless the barycentric coordinates are a hit's */       \
    } TriangleTest##N;                                                                             \
                                                                                                   \
    INLINE Vectors##N cross##N(Vectors##N a, Vectors##N b) {                                       \
        Vectors##N c;                                                                              \
        c.x = fma(a.y, b.z, -(a.z * b.y));                                                         \
        c.y = fma(a.z, b.x, -(a.x * b.z));                                                         \
        c.z = fma(a.x, b.y, -(a.y * b.x));                                                         \
        return c;                                                                                  \
    }                                                                                              \
    INLINE float##N dot##N(Vectors##N a, Vectors##N b) {                                           \
        return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));                                            \
    }                                                                                              \
    INLINE float##N flip_sign##N(float##N a, int##N sign) {                                        \
        return as_float##N(as_int##N(a) ^ sign);                                                   \
    }                                                                                              \
                                                                                                   \
    /* The sign is set where a < 0, which -0 is not: its bits less one have no sign. */            \
    INLINE uint##N sign_if_negative##N(float##N a) {                                               \
        return as_uint##N(a) & (as_uint##N(a) - 1u);                                               \
    }                                                                                              \
    /* Of the three coordinates times the determinant, none of which may be below 0, and of the    \
       determinant, which must be above: the bits of 0 less one have the sign. */                  \
    INLINE int##N sign_unless_inside##N(float##N u, float##N v, float##N w,                        \
                                        float##N determinant) {                                    \
        return as_int##N(sign_if_negative##N(u) | sign_if_negative##N(v) |                         \
                         sign_if_negative##N(w) | (as_uint##N(determinant) - 1u));                 \
    }                                                                                              \
                                                                                                   \
    INLINE TriangleTest##N test_triangles##N(Vectors##N origin, Vectors##N direction,              \
                                             Vectors##N v0, Vectors##N e1, Vectors##N e2) {        \
        const Vectors##N c = {v0.x - origin.x, v0.y - origin.y, v0.z - origin.z};                  \
        const Vectors##N normal = cross##N(e2, e1), across = cross##N(c, direction);               \
        const float##N determinant = dot##N(normal, direction);                                    \
        const int##N sign = as_int##N(determinant) & (int)0x80000000;                              \
        TriangleTest##N test;                                                                      \
        test.determinant = fabs(determinant);                                                      \
        test.u = flip_sign##N(dot##N(across, e2), sign ^ (int)0x80000000);                         \
        test.v = flip_sign##N(dot##N(across, e1), sign);                                           \
        test.t = flip_sign##N(dot##N(normal, c), sign);                                            \
        test.outside = sign_unless_inside##N(test.u, test.v, test.determinant - (test.u + test.v), \
                                             test.determinant);                                    \
        return test;                                                                               \
    }                                                                                              \
                                                                                                   \
    /* The sign is set unless t may lie in [t_min, t_max], and the rest is that of a hit. */       \
    INLINE int##N miss##N(TriangleTest##N test, float##N t_min, float##N t_max) {                  \
        const float##N lowest = test.determinant * (t_min * (1.0f - TRIANGLE_SLACK));              \
        const float##N highest = test.determinant * (t_max * (1.0f + TRIANGLE_SLACK));             \
        return test.outside | as_int##N(test.t - lowest) | as_int##N(highest - test.t);            \
    }

// Scalars as vectors of one; their comparisons give 1 where those of vectors give -1.
typedef float float1;
typedef int int1;
typedef uint uint1;
#define as_float1 as_float
#define as_int1 as_int
#define as_uint1 as_uint

DEFINE_TRIANGLES(1)
DEFINE_TRIANGLES(8)
DEFINE_TRIANGLES(16)

#endif
