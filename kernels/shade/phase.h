// Where light goes that a medium scatters.
#ifndef ONDE_SHADE_PHASE_H
#define ONDE_SHADE_PHASE_H

#include "math/sampling.h"

// Henyey and Greenstein 1941, per solid angle; cosine: of the direction on and the one after.
INLINE real phase_value(real cosine, real anisotropy) {
    const real square_of = anisotropy * anisotropy;
    const real base = max_real(fma(-2.0f * anisotropy, cosine, 1.0f + square_of), (real)(1e-6f));
    return (1.0f - square_of) / (base * sqrt(base)) * (0.25f * INV_PI);
}
// A direction that is as likely as its value; `on` is unit.
INLINE real3 phase_sample(real3 on, real anisotropy, real2 u) {
    const real g = anisotropy;
    const real plain = fma(-2.0f, u.x, (real)(1.0f));
    const real ratio = (1.0f - g * g) / fma(g, plain, (real)(1.0f));
    const mask even = fabs(g) < 1e-3f;
    const real bent = (1.0f + g * g - ratio * ratio) / choose(even, (real)(1.0f), 2.0f * g);
    const real cosine = clamp_real(choose(even, plain, bent), -1.0f, 1.0f);
    const SineCosine turn = sincos_turns(u.y);
    const real sine = safe_sqrt(1.0f - cosine * cosine);
    const real3 turned = make3(sine * turn.cosine, sine * turn.sine, cosine);
    return normalize3(to_world(make_basis(on), turned));
}

#endif
