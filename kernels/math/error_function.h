// The error function and its inverse, as needed for Gaussian slopes.
#ifndef ONDE_MATH_ERROR_FUNCTION_H
#define ONDE_MATH_ERROR_FUNCTION_H

#include "math/elementary.h"

#define INV_SQRT_PI 0.564189583547756f

// exp(-x^2).
INLINE real gaussian(real x) {
    return exp2_real(-1.44269504f * x * x);
}

// 1 - erf(x) over exp(-x^2), for x >= 0. Absolute error below 3e-7 (Abramowitz & Stegun 7.1.26).
INLINE real scaled_complement(real x) {
    const real t = 1.0f / fma(x, (real)(0.3275911f), (real)(1.0f));
    real p = fma(t, (real)(1.061405429f), (real)(-1.453152027f));
    p = fma(t, p, (real)(1.421413741f));
    p = fma(t, p, (real)(-0.284496736f));
    p = fma(t, p, (real)(0.254829592f));
    return p * t;
}

// erf(x) for x >= 0. Absolute error below 4e-7.
INLINE real error_function(real x) {
    return fma(-scaled_complement(x), gaussian(x), (real)(1.0f));
}

// The x whose erf(x) is y, for |y| < 1 (Giles 2010, Approximating the erfinv function). Relative
// error below 2e-6 where 1 - |y| has its digits.
INLINE real inverse_error_function(real y) {
    const real w = -0.69314718f * log2_real(max_real((1.0f - y) * (1.0f + y), (real)(1e-30f)));
    const real a = w - 2.5f;
    real p = fma(a, (real)(2.81022636e-08f), (real)(3.43273939e-07f));
    p = fma(a, p, (real)(-3.5233877e-06f));
    p = fma(a, p, (real)(-4.39150654e-06f));
    p = fma(a, p, (real)(2.1858087e-04f));
    p = fma(a, p, (real)(-1.25372503e-03f));
    p = fma(a, p, (real)(-4.17768164e-03f));
    p = fma(a, p, (real)(0.246640727f));
    p = fma(a, p, (real)(1.50140941f));
    const real b = safe_sqrt(w) - 3.0f;
    real q = fma(b, (real)(-2.00214257e-04f), (real)(1.00950558e-04f));
    q = fma(b, q, (real)(1.34934322e-03f));
    q = fma(b, q, (real)(-3.67342844e-03f));
    q = fma(b, q, (real)(5.73950773e-03f));
    q = fma(b, q, (real)(-7.6224613e-03f));
    q = fma(b, q, (real)(9.43887047e-03f));
    q = fma(b, q, (real)(1.00167406f));
    q = fma(b, q, (real)(2.83297682f));
    return choose(w < 5.0f, p, q) * y;
}

#endif
