// The BSDF: a sum of lobes, and the choice among them. Local directions: the shading normal is +z,
// wo is above. What a lobe is stands in shade/lobes/lobe.h; which ones there are in LOBES.
#ifndef ONDE_SHADE_BSDF_H
#define ONDE_SHADE_BSDF_H

#include "shade/lobes/dielectric.h"
#include "shade/lobes/diffuse.h"
#include "shade/lobes/glossy.h"

// Bit LOBE_...: the lobes that some material of the scene has.
#ifndef ONDE_LOBES
    #define ONDE_LOBES 0xffffffffu
#endif
#define HAS_LOBE(NAME) (ONDE_LOBES >> LOBE_##NAME & 1u)

// The probability of a lobe that a material has is no smaller.
#define LEAST_LOBE_PROBABILITY 0.1f

#define LOBE_MASK(NAME, name, Type, transmits, kinds) mask name;
typedef struct {
    LOBES(LOBE_MASK)
} LobeMasks;
#define LOBE_NUMBER(NAME, name, Type, transmits, kinds) real name;
typedef struct {
    LOBES(LOBE_NUMBER)
} LobeNumbers;

#define LOBE_MEMBER(NAME, name, Type, transmits, kinds) Type name;
typedef struct {
    LOBES(LOBE_MEMBER)
    LobeMasks has;
    LobeNumbers probability; // of choosing a lobe
    LobeNumbers reach;       // and of choosing it or one that LOBES has after it
} Bsdf;

typedef struct {
    real3 value; // BSDF times cosine
    real pdf;
} BsdfValue;

typedef struct {
    real3 wi;
    real3 weight; // BSDF times cosine over pdf
    real pdf;     // 0 after a delta lobe
    mask delta;
    mask valid;
} BsdfSample;

// The weights of the lobes that are there, and their number, from one of LOBES on.
typedef struct {
    real weight, count;
} LobeSum;

INLINE LobeSum lobes_from(uint first, LobeMasks there, LobeNumbers weight) {
    LobeSum sum;
    sum.weight = sum.count = (real)(0.0f);
#define ADD_LOBE(NAME, name, Type, transmits, kinds)                                               \
    if (HAS_LOBE(NAME) && LOBE_##NAME >= first) {                                                  \
        sum.weight += choose(there.name, weight.name, (real)(0.0f));                               \
        sum.count += choose(there.name, (real)(1.0f), (real)(0.0f));                               \
    }
    LOBES(ADD_LOBE)
#undef ADD_LOBE
    return sum;
}

// The probability of choosing a lobe from `first` on, by what the lobes reflect.
INLINE real lobe_reach(uint first, LobeMasks there, LobeNumbers weight) {
    const LobeSum all = lobes_from(0, there, weight), from = lobes_from(first, there, weight);
    const real before = all.count - from.count;
    const real low = LEAST_LOBE_PROBABILITY * from.count;
    const real high = 1.0f - LEAST_LOBE_PROBABILITY * before;
    const real share = from.weight / max_real(all.weight, (real)(1e-6f));
    return choose(before > 0.0f, min_real(max_real(share, low), high), (real)(1.0f));
}

// cosine: of the view direction and the shading normal, > 0.
INLINE Bsdf bsdf_load(SceneView view, MaterialPoint m, real cosine) {
    Bsdf b;
    LobeMasks there;
    LobeNumbers weight;
#define LOAD_LOBE(NAME, name, Type, transmits, kinds)                                              \
    if (HAS_LOBE(NAME)) {                                                                          \
        b.name = name##_load(view, m);                                                             \
        b.has.name = ((natural)(kinds) >> m.kind & 1u) != 0u;                                      \
        weight.name = name##_weight(b.name, cosine);                                               \
        there.name = b.has.name & (weight.name > 0.0f);                                            \
    }
    LOBES(LOAD_LOBE)
#undef LOAD_LOBE
#define CHOOSE_LOBE(NAME, name, Type, transmits, kinds)                                            \
    if (HAS_LOBE(NAME)) {                                                                          \
        b.reach.name = lobe_reach(LOBE_##NAME, there, weight);                                     \
        b.probability.name = b.reach.name - lobe_reach(LOBE_##NAME + 1, there, weight);            \
    }
    LOBES(CHOOSE_LOBE)
#undef CHOOSE_LOBE
    return b;
}

// Delta lobes are left out: their value and pdf are zero here.
INLINE BsdfValue bsdf_eval(Bsdf b, real3 wo, real3 wi) {
    BsdfValue v;
    v.value = zero3();
    v.pdf = (real)(0.0f);
#define EVAL_LOBE(NAME, name, Type, transmits, kinds)                                              \
    if (HAS_LOBE(NAME)) {                                                                          \
        if_any (b.has.name) {                                                                      \
            const LobeValue lobe = name##_eval(b.name, wo, wi);                                    \
            const real pdf = name##_pdf(b.name, wo, wi);                                           \
            v.value = choose(b.has.name, fma3(lobe.tint, lobe.value, v.value), v.value);           \
            v.pdf = choose(b.has.name, fma(b.probability.name, pdf, v.pdf), v.pdf);                \
        }                                                                                          \
    }
    LOBES(EVAL_LOBE)
#undef EVAL_LOBE
    return v;
}

// choice picks the lobe, u the direction; all in [0, 1).
INLINE BsdfSample bsdf_sample(Bsdf b, real3 wo, real choice, real2 u) {
    LobeSample lobe;
    lobe.wi = lobe.weight = zero3();
    lobe.delta = lobe.valid = choice < 0.0f;
    real probability = (real)(1.0f);
#define SAMPLE_LOBE(NAME, name, Type, transmits, kinds)                                            \
    if (HAS_LOBE(NAME)) {                                                                          \
        const mask chosen = (choice < b.reach.name) & (b.probability.name > 0.0f);                 \
        if_any (chosen) {                                                                          \
            lobe = choose(chosen, name##_sample(b.name, wo, choice, u), lobe);                     \
            probability = choose(chosen, b.probability.name, probability);                         \
        }                                                                                          \
    }
    LOBES(SAMPLE_LOBE)
#undef SAMPLE_LOBE
    const BsdfValue v = bsdf_eval(b, wo, lobe.wi);
    BsdfSample s;
    s.wi = lobe.wi;
    s.delta = lobe.delta;
    s.weight = choose(lobe.delta, scale3(lobe.weight, 1.0f / max_real(probability, (real)(1e-9f))),
                      scale3(v.value, 1.0f / max_real(v.pdf, (real)(1e-30f))));
    s.pdf = choose(lobe.delta, (real)(0.0f), v.pdf);
    s.valid = lobe.valid & (lobe.delta | (v.pdf > 0.0f));
    return s;
}

// Whether light may pass the surface.
INLINE mask bsdf_transmits(Bsdf b) {
    mask passes = (mask)(0);
#define ADD_LOBE(NAME, name, Type, transmits, kinds)                                               \
    if (HAS_LOBE(NAME) && transmits) passes = passes | b.has.name;
    LOBES(ADD_LOBE)
#undef ADD_LOBE
    return passes;
}

// The index below over the index above, where light is refracted; 1 elsewhere.
INLINE real bsdf_eta(Bsdf b) {
    const real one = (real)(1.0f);
    return HAS_LOBE(DIELECTRIC) ? choose(b.has.dielectric, b.dielectric.eta, one) : one;
}

#endif
