// What every lobe of a BSDF gives and takes. Local directions: the shading normal is +z, wo is
// above. A lobe `name` is a file of this folder and a line of LOBES in shared/scene.h:
//   name_load(view, point)              its numbers, from a material's
//   name_weight(lobe, cosine)           about how much it reflects, for the choice among lobes
//   name_eval(lobe, wo, wi)             BSDF times cosine, without its delta part
//   name_pdf(lobe, wo, wi)              the density of name_sample, without its delta part
//   name_sample(lobe, wo, choice, u)    a direction
#ifndef ONDE_SHADE_LOBES_LOBE_H
#define ONDE_SHADE_LOBES_LOBE_H

#include "math/sampling.h"
#include "shade/fresnel.h"
#include "shade/texture.h"

// A material at a point: what several lobes need of it, textures and all. What one lobe needs it
// reads itself.
typedef struct {
    natural material; // index
    natural kind;     // MATERIAL_...
    real2 uv;
    real3 color;
    real alpha; // roughness^2
    real metallic;
    mask front; // whether its front is seen
} MaterialPoint;

// The value is the product; the sum of lobes rounds once.
typedef struct {
    real3 tint, value;
} LobeValue;

typedef struct {
    real3 wi;
    mask delta;   // wi is the only direction
    real3 weight; // of that direction: BSDF times cosine over pdf
    mask valid;   // wi lies on the side that it should
} LobeSample;

OVERLOAD LobeSample choose(mask m, LobeSample a, LobeSample b) {
    LobeSample s;
    s.wi = choose(m, a.wi, b.wi);
    s.delta = choose(m, a.delta, b.delta);
    s.weight = choose(m, a.weight, b.weight);
    s.valid = choose(m, a.valid, b.valid);
    return s;
}

INLINE LobeValue no_lobe_value(void) {
    LobeValue v;
    v.tint = v.value = zero3();
    return v;
}

#endif
