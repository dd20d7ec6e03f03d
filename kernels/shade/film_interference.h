// The reflectance of a boundary below a thin film, for light as eyes see it: Belcour and Barla, "A
// Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", 2017, as
// KHR_materials_iridescence states it.
#ifndef ONDE_SHADE_FILM_INTERFERENCE_H
#define ONDE_SHADE_FILM_INTERFERENCE_H

#include "shade/fresnel.h"

// The eye's responses to equal energy, as Gaussians (there, section 4 of the supplement): heights,
// turns per nanometre, decay per square nanometre.
#define FILM_X_HEIGHT 0.846590f
#define FILM_X_TURNS 0.001681f
#define FILM_X_DECAY 2.46491e-07f
#define FILM_Y_HEIGHT 1.000222f
#define FILM_Y_TURNS 0.0017953f
#define FILM_Y_DECAY 5.29946e-07f
#define FILM_Z_HEIGHT 1.001122f
#define FILM_Z_TURNS 0.0022084f
#define FILM_Z_DECAY 3.76594e-07f
#define FILM_X2_HEIGHT 0.153868f
#define FILM_X2_TURNS 0.0022399f
#define FILM_X2_DECAY 2.57905e-07f

typedef struct {
    real ior;
    real thickness; // nanometres
} Film;

// Of a boundary's index and reflectance at normal incidence, each from the other.
INLINE real f0_of_ior(real inside, real outside) {
    return square((inside - outside) / (inside + outside));
}
INLINE real ior_of_f0(real f0) {
    const real root = sqrt(clamp_real(f0, 0.0f, 0.9999f));
    return (1.0f + root) / (1.0f - root);
}

// One Gaussian of the eye's response, in Fourier space: height times the cosine of a path
// difference (nanometres) and a phase (turns). `per_nm`: turns; `decay`: of the square, base 2.
INLINE real eye_response(real height, float per_nm, float decay, real difference, real phase) {
    const real turns = fma(difference, (real)(per_nm), phase);
    const real fading = exp2_real(difference * difference * -decay);
    return height * fading * sincos_turns(turns - floor(turns)).cosine;
}

// What interference of a path difference adds, by Rec. 709 channels; a phase for each.
INLINE real3 interference(real difference, real3 phase) {
    const real one = (real)(1.0f);
    const real x =
        eye_response(one * FILM_X_HEIGHT, FILM_X_TURNS, FILM_X_DECAY, difference, phase.x) +
        eye_response(one * FILM_X2_HEIGHT, FILM_X2_TURNS, FILM_X2_DECAY, difference, phase.x);
    const real y =
        eye_response(one * FILM_Y_HEIGHT, FILM_Y_TURNS, FILM_Y_DECAY, difference, phase.y);
    const real z =
        eye_response(one * FILM_Z_HEIGHT, FILM_Z_TURNS, FILM_Z_DECAY, difference, phase.z);
    return make3(fma(x, (real)(3.2404542f), fma(y, (real)(-1.5371385f), z * -0.4985314f)),
                 fma(x, (real)(-0.9692660f), fma(y, (real)(1.8760108f), z * 0.0415560f)),
                 fma(x, (real)(0.0556434f), fma(y, (real)(-0.2040259f), z * 1.0572252f)));
}

// From film to base, of one channel: reflectance, and half a turn where the base is the thinner.
typedef struct {
    real reflectance, phase;
} FilmBase;
INLINE FilmBase film_base(real ior, real f0, real cosine) {
    const real base = ior_of_f0(f0);
    const real r0 = f0_of_ior(base, ior);
    FilmBase b;
    b.reflectance = fma(1.0f - r0, schlick_weight(cosine), r0);
    b.phase = choose(base < ior, (real)(0.5f), (real)(0.0f));
    return b;
}

// f0: of the boundary without the film; cosine: outside.
INLINE real3 film_fresnel(Film film, real3 f0, real cosine) {
    const real ior = film.ior;
    const real inside2 = 1.0f - (1.0f - cosine * cosine) / (ior * ior);
    const real inside = safe_sqrt(inside2);
    const real top0 = f0_of_ior(ior, (real)(1.0f));
    const real top = fma(1.0f - top0, schlick_weight(cosine), top0);
    const real passes = 1.0f - top;
    const FilmBase r = film_base(ior, f0.x, inside), g = film_base(ior, f0.y, inside);
    const FilmBase b = film_base(ior, f0.z, inside);
    const real3 base = make3(r.reflectance, g.reflectance, b.reflectance);
    const real3 phase = make3(0.5f + r.phase, 0.5f + g.phase, 0.5f + b.phase);
    const real3 both =
        make3(clamp_real(top * base.x, 1e-5f, 0.9999f), clamp_real(top * base.y, 1e-5f, 0.9999f),
              clamp_real(top * base.z, 1e-5f, 0.9999f));
    const real3 root = make3(sqrt(both.x), sqrt(both.y), sqrt(both.z));
    const real3 inner = make3(passes * passes * base.x / (1.0f - both.x),
                              passes * passes * base.y / (1.0f - both.y),
                              passes * passes * base.z / (1.0f - both.z));
    const real difference = 2.0f * ior * film.thickness * inside;
    real3 sum = add3(splat3(top), inner);
    real3 order = mul3(sub3(inner, splat3(passes)), root);
    sum = madd3(mul3(order, interference(difference, phase)), (real)(2.0f), sum);
    order = mul3(order, root);
    sum = madd3(mul3(order, interference(2.0f * difference, scale3(phase, (real)(2.0f)))),
                (real)(2.0f), sum);
    return make3(clamp_real(sum.x, 0.0f, 1.0f), clamp_real(sum.y, 0.0f, 1.0f),
                 clamp_real(sum.z, 0.0f, 1.0f));
}

#endif
