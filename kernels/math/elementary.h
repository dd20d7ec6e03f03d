// Elementary functions with the same bits at every width and on every device. Polynomials are
// minimax fits; errors are stated and tested.
#ifndef ONDE_MATH_ELEMENTARY_H
#define ONDE_MATH_ELEMENTARY_H

#include "math/vector.h"

#define PI 3.14159265358979f
#define INV_PI 0.318309886183791f

INLINE real square(real a) {
    return a * a;
}
INLINE real safe_sqrt(real a) {
    return sqrt(max_real(a, (real)(0.0f)));
}

typedef struct {
    real sine, cosine;
} SineCosine;

// Of 2 pi u, for |u| up to a few turns. Absolute error below 3e-7.
INLINE SineCosine sincos_turns(real u) {
    const real quarters = u * 4.0f;
    const real nearest = floor(quarters + 0.5f);
    const integer k = to_integer(nearest);
    const real r = (quarters - nearest) * 1.57079632679f;
    const real r2 = r * r;
    real s = fma(r2, (real)(-1.9515295891e-4f), (real)(8.3321608736e-3f));
    s = fma(r2, s, (real)(-1.6666654611e-1f));
    s = fma(r * r2, s, r);
    real c = fma(r2, (real)(2.443315711809948e-5f), (real)(-1.388731625493765e-3f));
    c = fma(r2, c, (real)(4.166664568298827e-2f));
    c = fma(r2 * r2, c, fma(r2, (real)(-0.5f), (real)(1.0f)));
    const mask swapped = (k & 1) != 0;
    const real sine = choose(swapped, c, s), cosine = choose(swapped, s, c);
    SineCosine result;
    result.sine = choose((k & 2) != 0, -sine, sine);
    result.cosine = choose(((k + 1) & 2) != 0, -cosine, cosine);
    return result;
}

// Base 2, of x = 1 + above > 0 that is no denormal: `above` has the digits that x has lost.
INLINE real log2_near_one(real x, real above) {
    const integer bits = as_integer(x);
    const integer shifted = bits - 0x3f3504f3; // sqrt(1/2): the mantissa ends up around 1
    const integer exponent = shifted >> 23;
    const real m = as_real(bits - (exponent << 23));
    const real s = choose(exponent == 0, above, m - 1.0f) / (m + 1.0f); // 2 atanh(s) = ln m
    const real s2 = s * s;
    real p = fma(s2, (real)(1.0f / 9.0f), (real)(1.0f / 7.0f));
    p = fma(s2, p, (real)(1.0f / 5.0f));
    p = fma(s2, p, (real)(1.0f / 3.0f));
    p = fma(s2 * s, p, s) * 2.88539008f; // 2 / ln 2
    return to_real(exponent) + p;
}

// Base 2, of x > 0 that is no denormal. Absolute error below 2e-7, relative near 1.
INLINE real log2_real(real x) {
    return log2_near_one(x, x - 1.0f);
}

// 2^x; 0 below -126. Relative error below 3e-7 for x <= 127.
INLINE real exp2_real(real x) {
    const real clamped = clamp_real(x, -126.0f, 127.0f);
    const real whole = floor(clamped + 0.5f);
    const real f = (clamped - whole) * 0.693147181f;
    real p = fma(f, (real)(1.0f / 5040.0f), (real)(1.0f / 720.0f));
    p = fma(f, p, (real)(1.0f / 120.0f));
    p = fma(f, p, (real)(1.0f / 24.0f));
    p = fma(f, p, (real)(1.0f / 6.0f));
    p = fma(f, p, (real)(0.5f));
    p = fma(f, p, (real)(1.0f));
    p = fma(f, p, (real)(1.0f));
    const real power = as_real((to_integer(whole) + 127) << 23);
    return choose(x < -126.0f, (real)(0.0f), p * power);
}

// (1 - x)^y for x in [0, 1], y >= 0; 0^0 is 1. Small x keep their digits, which y multiplies.
INLINE real power_below_one(real x, real y) {
    const real base = 1.0f - x;
    const mask positive = base > 1.2e-38f;
    const real safe = choose(positive, x, (real)(0.0f));
    const real power = exp2_real(y * log2_near_one(1.0f - safe, -safe));
    return choose(positive, power, choose(y == 0.0f, (real)(1.0f), (real)(0.0f)));
}

// The angle of (x, y) in turns, in [0, 1]. (0, 0) gives 0. Absolute error below 1e-6.
INLINE real angle_turns(real y, real x) {
    const real ax = fabs(x), ay = fabs(y);
    const real big = max_real(ax, ay), small = min_real(ax, ay);
    const real a = small / max_real(big, (real)(1e-37f));
    const real a2 = a * a;
    real p = fma(a2, (real)(-0.0040540580f), (real)(0.0218612288f)); // Abramowitz & Stegun 4.4.49
    p = fma(a2, p, (real)(-0.0559098861f));
    p = fma(a2, p, (real)(0.0964200441f));
    p = fma(a2, p, (real)(-0.1390853351f));
    p = fma(a2, p, (real)(0.1994653599f));
    p = fma(a2, p, (real)(-0.3332985605f));
    p = fma(a2, p, (real)(0.9999993329f));
    real turns = a * p * (0.5f * INV_PI);
    turns = choose(ay > ax, 0.25f - turns, turns);
    turns = choose(x < 0.0f, 0.5f - turns, turns);
    return choose(y < 0.0f, 1.0f - turns, turns);
}

// The number whose half (IEEE 754 binary16) is in the lower 16 bits; from 0 on, and finite.
INLINE real from_half(natural bits) {
    const real normal = as_real((bits << 13u) + 0x38000000u); // its exponent counts from 112 less
    return choose(bits < 0x400u, to_real(as_integer(bits)) * 5.9604644775390625e-8f, normal);
}

// Unit vector from two signed 16-bit octahedral coordinates (Cigolle et al. 2014).
INLINE real3 decode_octahedral(natural word) {
    real x = to_real(as_integer(word << 16) >> 16) * (1.0f / 32767.0f);
    real y = to_real(as_integer(word) >> 16) * (1.0f / 32767.0f);
    const real z = 1.0f - fabs(x) - fabs(y);
    const real fold = max_real(-z, (real)(0.0f));
    x += choose(x >= 0.0f, -fold, fold);
    y += choose(y >= 0.0f, -fold, fold);
    return normalize3(make3(x, y, z));
}

#endif
