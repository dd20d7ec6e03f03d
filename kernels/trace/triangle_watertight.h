// Rays against triangles without gaps, after Woop, Benthin and Wald, "Watertight ray/triangle
// intersection", JCGT 2013: corners are sheared so that the ray runs along z; then the origin is on
// the same side of a shared edge for both triangles, or on it for both. Ties are decided by the
// rounding errors of the products, where the paper takes double precision. Barring underflow, no
// ray passes between triangles whose shared corners have the same bits.
#ifndef ONDE_TRACE_TRIANGLE_WATERTIGHT_H
#define ONDE_TRACE_TRIANGLE_WATERTIGHT_H

#include "trace/triangle.h"

#define DEFINE_WATERTIGHT(N)                                                                       \
    /* The axis that the direction is longest along becomes z, by a cyclic exchange. */            \
    INLINE Vectors##N turn_axes##N(Vectors##N v, int##N y_longest, int##N z_longest) {             \
        Vectors##N turned;                                                                         \
        turned.x = z_longest ? v.x : y_longest ? v.z : v.y;                                        \
        turned.y = z_longest ? v.y : y_longest ? v.x : v.z;                                        \
        turned.z = z_longest ? v.z : y_longest ? v.y : v.x;                                        \
        return turned;                                                                             \
    }                                                                                              \
    /* a b - c d, rounded, but never of the wrong sign and 0 only where it is. */                  \
    INLINE float##N signed_difference##N(float##N a, float##N b, float##N c, float##N d) {         \
        const float##N p = a * b, q = c * d, difference = p - q;                                   \
        return difference != 0.0f ? difference : fma(a, b, -p) - fma(c, d, -q);                    \
    }                                                                                              \
    /* From the origin, x and y moved along the ray to z = 0. */                                   \
    INLINE Vectors##N sheared##N(Vectors##N corner, Vectors##N origin, float##N shear_x,           \
                                 float##N shear_y) {                                               \
        Vectors##N v = {corner.x - origin.x, corner.y - origin.y, corner.z - origin.z};            \
        v.x = fma(-shear_x, v.z, v.x);                                                             \
        v.y = fma(-shear_y, v.z, v.y);                                                             \
        return v;                                                                                  \
    }                                                                                              \
    /* As test_triangles, of corners instead of edges. */                                          \
    INLINE TriangleTest##N test_watertight##N(Vectors##N origin, Vectors##N direction,             \
                                              Vectors##N corner0, Vectors##N corner1,              \
                                              Vectors##N corner2) {                                \
        const float##N size_x = fabs(direction.x), size_y = fabs(direction.y);                     \
        const float##N size_z = fabs(direction.z);                                                 \
        const int##N z_longest = (size_z >= size_x) & (size_z >= size_y);                          \
        const int##N y_longest = size_y >= size_x;                                                 \
        const Vectors##N o = turn_axes##N(origin, y_longest, z_longest);                           \
        const Vectors##N d = turn_axes##N(direction, y_longest, z_longest);                        \
        const float##N inverse_z = 1.0f / d.z;                                                     \
        const float##N shear_x = d.x * inverse_z, shear_y = d.y * inverse_z;                       \
        const Vectors##N a =                                                                       \
            sheared##N(turn_axes##N(corner0, y_longest, z_longest), o, shear_x, shear_y);          \
        const Vectors##N b =                                                                       \
            sheared##N(turn_axes##N(corner1, y_longest, z_longest), o, shear_x, shear_y);          \
        const Vectors##N c =                                                                       \
            sheared##N(turn_axes##N(corner2, y_longest, z_longest), o, shear_x, shear_y);          \
        const float##N of_a = signed_difference##N(c.x, b.y, c.y, b.x);                            \
        const float##N of_b = signed_difference##N(a.x, c.y, a.y, c.x);                            \
        const float##N of_c = signed_difference##N(b.x, a.y, b.y, a.x);                            \
        const float##N determinant = of_a + of_b + of_c;                                           \
        const int##N sign = as_int##N(determinant) & (int)0x80000000;                              \
        TriangleTest##N test;                                                                      \
        test.determinant = fabs(determinant);                                                      \
        test.u = flip_sign##N(of_b, sign);                                                         \
        test.v = flip_sign##N(of_c, sign);                                                         \
        test.t = flip_sign##N(fma(of_a, a.z, fma(of_b, b.z, of_c * c.z)) * inverse_z, sign);       \
        test.outside =                                                                             \
            sign_unless_inside##N(test.u, test.v, flip_sign##N(of_a, sign), test.determinant);     \
        return test;                                                                               \
    }

DEFINE_WATERTIGHT(1)
DEFINE_WATERTIGHT(8)
DEFINE_WATERTIGHT(16)

// The test that the tree's leaf blocks are made for.
#if ONDE_WATERTIGHT
    #define leaf_test1 test_watertight1
    #define leaf_test8 test_watertight8
    #define leaf_test16 test_watertight16
#else
    #define leaf_test1 test_triangles1
    #define leaf_test8 test_triangles8
    #define leaf_test16 test_triangles16
#endif

#endif
