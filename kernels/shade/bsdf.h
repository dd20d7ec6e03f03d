// The BSDF: a sum of lobes, and the choice among them. Local directions: the shading normal is +z,
// wo is above. What a lobe is stands in shade/lobes/lobe.h; which ones there are in LOBES.
#ifndef ONDE_SHADE_BSDF_H
#define ONDE_SHADE_BSDF_H

#include "math/random.h"
#include "shade/lobes/behind.h"
#include "shade/lobes/coat.h"
#include "shade/lobes/dielectric.h"
#include "shade/lobes/diffuse.h"
#include "shade/lobes/glossy.h"
#include "shade/lobes/sheen.h"
#include "shade/lobes/thin.h"

// Whether some material of the scene has a lobe, and whether all have it.
#define HAS_LOBE(NAME) (ONDE_LOBES >> LOBE_##NAME & 1u)
#define ALL_HAVE_LOBE(NAME) (ONDE_COMMON_LOBES >> LOBE_##NAME & 1u)

// Whether something may lie on top of other lobes.
#define HAS_LAYERS (HAS_LOBE(COAT) || HAS_LOBE(SHEEN))

// The probability of a lobe that a material has is no smaller.
#define LEAST_LOBE_PROBABILITY 0.02f

#define LOBE_MASK(NAME, name, Type, transmits) mask name;
typedef struct {
    LOBES(LOBE_MASK)
} LobeMasks;
#define LOBE_NUMBER(NAME, name, Type, transmits) real name;
typedef struct {
    LOBES(LOBE_NUMBER)
} LobeNumbers;

#define LOBE_MEMBER(NAME, name, Type, transmits) Type name;
typedef struct {
    LOBES(LOBE_MEMBER)
    LobeMasks has;
    LobeNumbers probability; // of choosing a lobe
    LobeNumbers reach;       // and of choosing it or one that LOBES has after it
    LobeNumbers through;     // the layers on top of it, toward wo
#if ONDE_ADJOINT
    SceneView view;
    MaterialPoint point;
#endif
} Bsdf;

// What layers leave to those below of light along w. As light is scattered between them the sum
// keeps its energy, though not its reciprocity.
INLINE LobeNumbers layers_through(Bsdf b, real3 w) {
    real left = (real)(1.0f);
    LobeNumbers through;
#define PASS_LAYER(NAME, name, Type, transmits)                                                    \
    through.name = left;                                                                           \
    if (LOBE_##NAME == LOBE_COAT && HAS_LOBE(COAT))                                                \
        left = choose(b.has.coat, left * (1.0f - coat_albedo(b.coat, w)), left);                   \
    if (LOBE_##NAME == LOBE_SHEEN && HAS_LOBE(SHEEN))                                              \
        left = choose(b.has.sheen, left * (1.0f - sheen_albedo(b.sheen, w)), left);
    LOBES(PASS_LAYER)
#undef PASS_LAYER
    return through;
}

// What the layers of a material leave of light along m.wo.
INLINE real left_by_layers(SceneView view, MaterialPoint m, natural lobes) {
    real left = (real)(1.0f);
#define LEAVE_LAYER(NAME, name)                                                                    \
    if (HAS_LOBE(NAME)) {                                                                          \
        const mask there = (lobes >> LOBE_##NAME & 1u) != 0u;                                      \
        const real share = 1.0f - name##_albedo(name##_load(view, m), m.wo);                       \
        left *= choose(there, share, (real)(1.0f));                                                \
    }
    LEAVE_LAYER(COAT, coat)
    LEAVE_LAYER(SHEEN, sheen)
#undef LEAVE_LAYER
    return left;
}

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
#if ONDE_PANES
    mask straight; // wi goes on through a thin wall, as light from a light may
#endif
} BsdfSample;

// The weights of some lobes, and their number.
typedef struct {
    real weight, count;
} LobeSum;

INLINE LobeSum with_lobe(LobeSum sum, mask there, real weight) {
    sum.weight += choose(there, weight, (real)(0.0f));
    sum.count += choose(there, (real)(1.0f), (real)(0.0f));
    return sum;
}

// The probability of choosing a lobe behind those `before`, by what the lobes reflect. scale: one
// over the weight of all.
INLINE real lobe_reach(LobeSum all, LobeSum before, real scale) {
    const real low = LEAST_LOBE_PROBABILITY * (all.count - before.count);
    const real high = 1.0f - LEAST_LOBE_PROBABILITY * before.count;
    const real share = (all.weight - before.weight) * scale;
    return choose(before.count > 0.0f, min_real(max_real(share, low), high), (real)(1.0f));
}

INLINE Bsdf bsdf_load(SceneView view, MaterialPoint m) {
    Bsdf b;
#if ONDE_ADJOINT
    b.view = view;
    b.point = m;
#endif
    const natural lobes = RECORD_NATURAL(view.materials, m.material, MaterialRecord, lobes);
    LobeMasks there;
    LobeNumbers weight;
#define LOAD_LOBE(NAME, name, Type, transmits)                                                     \
    if (HAS_LOBE(NAME)) {                                                                          \
        b.name = name##_load(view, m);                                                             \
        b.has.name = ALL_HAVE_LOBE(NAME) ? m.kind == m.kind : (lobes >> LOBE_##NAME & 1u) != 0u;   \
        weight.name = name##_weight(b.name, m);                                                    \
        there.name = b.has.name & (weight.name > 0.0f);                                            \
    }
    LOBES(LOAD_LOBE)
#undef LOAD_LOBE
    if (HAS_LAYERS) {
        b.through = layers_through(b, m.wo);
#define DIM_LOBE(NAME, name, Type, transmits) weight.name *= b.through.name;
        LOBES(DIM_LOBE)
#undef DIM_LOBE
    }
    LobeSum all, before;
    all.weight = all.count = before.weight = before.count = (real)(0.0f);
#define ADD_LOBE(NAME, name, Type, transmits)                                                      \
    if (HAS_LOBE(NAME)) all = with_lobe(all, there.name, weight.name);
    LOBES(ADD_LOBE)
#undef ADD_LOBE
    const real scale = 1.0f / max_real(all.weight, (real)(1e-6f));
    real reach = (real)(1.0f);
#define CHOOSE_LOBE(NAME, name, Type, transmits)                                                   \
    if (HAS_LOBE(NAME)) {                                                                          \
        b.reach.name = reach;                                                                      \
        before = with_lobe(before, there.name, weight.name);                                       \
        reach = lobe_reach(all, before, scale);                                                    \
        b.probability.name = b.reach.name - reach;                                                 \
    }
    LOBES(CHOOSE_LOBE)
#undef CHOOSE_LOBE
    return b;
}

#if ONDE_ADJOINT
// What reflects along wi what comes along wo: losses are those of wi.
INLINE Bsdf bsdf_exchanged(Bsdf b, real3 wi) {
    b.point.cosine = fabs(wi.z);
    b.point.albedo = microfacet_albedo(b.view, b.point, wi, is_glossy(b.point));
    if (HAS_LOBE(DIFFUSE)) b.diffuse = diffuse_load(b.view, b.point);
    if (HAS_LOBE(BEHIND)) b.behind = behind_load(b.view, b.point);
    if (HAS_LOBE(GLOSSY)) b.glossy = glossy_load(b.view, b.point);
    if (HAS_LAYERS) b.through = layers_through(b, wi);
    return b;
}
#endif

// Delta lobes are left out: their value and pdf are zero here.
INLINE BsdfValue bsdf_eval(Bsdf b, real3 wo, real3 wi) {
    BsdfValue v;
    v.value = zero3();
    v.pdf = (real)(0.0f);
#if ONDE_ADJOINT
    b = bsdf_exchanged(b, wi);
#endif
#define EVAL_LOBE(NAME, name, Type, transmits)                                                     \
    if (HAS_LOBE(NAME)) {                                                                          \
        if_any (b.has.name) {                                                                      \
            const LobeValue lobe = name##_eval(b.name, wo, wi, b.has.name);                        \
            const real3 tint = HAS_LAYERS ? scale3(lobe.tint, b.through.name) : lobe.tint;         \
            v.value = fma3(tint, lobe.value, v.value);                                             \
            v.pdf = fma(b.probability.name, lobe.pdf, v.pdf);                                      \
        }                                                                                          \
    }
    LOBES(EVAL_LOBE)
#undef EVAL_LOBE
    return v;
}

// Within 0 and 1; 0 of nothing, and 1 of what is all but for its rounding.
INLINE real share_of(real part, real whole) {
    const real share = choose(part < whole * 0.999999f, part / whole, (real)(1.0f));
    return choose(whole > 0.0f, share, (real)(0.0f));
}

// What is left of a choice that has picked a lobe, in [0, 1).
INLINE real rest_of_choice(real choice, real reach, real probability) {
    const real rest = (choice - (reach - probability)) / max_real(probability, (real)(1e-6f));
    return clamp_real(rest, 0.0f, LARGEST_BELOW_ONE);
}

// choice picks the lobe, u the direction; all in [0, 1).
INLINE BsdfSample bsdf_sample(Bsdf b, real3 wo, real choice, real2 u) {
    LobeSample lobe;
    lobe.wi = lobe.weight = zero3();
    lobe.delta = lobe.valid = choice < 0.0f;
    real probability = (real)(1.0f), through = (real)(1.0f);
#define SAMPLE_LOBE(NAME, name, Type, transmits)                                                   \
    if (HAS_LOBE(NAME)) {                                                                          \
        const mask chosen = (choice < b.reach.name) & (b.probability.name > 0.0f);                 \
        if_any (chosen) {                                                                          \
            real own = choice;                                                                     \
            if (transmits) own = rest_of_choice(choice, b.reach.name, b.probability.name);         \
            lobe = choose(chosen, name##_sample(b.name, wo, own, u), lobe);                        \
            probability = choose(chosen, b.probability.name, probability);                         \
            if (HAS_LAYERS) {                                                                      \
                if (ONDE_ADJOINT) b.through = layers_through(b, lobe.wi);                          \
                through = choose(chosen, b.through.name, through);                                 \
            }                                                                                      \
        }                                                                                          \
    }
    LOBES(SAMPLE_LOBE)
#undef SAMPLE_LOBE
    const BsdfValue v = bsdf_eval(b, wo, lobe.wi);
    BsdfSample s;
    s.wi = lobe.wi;
    s.delta = lobe.delta;
    s.weight = scale3(v.value, 1.0f / max_real(v.pdf, (real)(1e-30f)));
    if_any (lobe.delta) {
        const real inverse = through / max_real(probability, (real)(1e-9f));
        s.weight = choose(lobe.delta, scale3(lobe.weight, inverse), s.weight);
    }
    s.pdf = choose(lobe.delta, (real)(0.0f), v.pdf);
    s.valid = lobe.valid & (lobe.delta | (v.pdf > 0.0f));
#if ONDE_PANES
    const mask pane = HAS_LOBE(DIELECTRIC) ? b.has.thin & !b.has.dielectric : b.has.thin;
    s.straight = pane & lobe.delta & (lobe.wi.z < 0.0f);
#endif
    return s;
}

// Whether light toward wi depends on its wavelength: what is refracted, or comes from inside.
INLINE mask bsdf_disperses(Bsdf b, real3 wi) {
#if ONDE_DISPERSION
    if (HAS_LOBE(DIELECTRIC))
        return b.has.dielectric & b.dielectric.disperses & (b.dielectric.inside | (wi.z < 0.0f));
#endif
    return (mask)(0);
}

// Whether light may pass the surface.
INLINE mask bsdf_transmits(Bsdf b) {
    mask passes = (mask)(0);
#define ADD_LOBE(NAME, name, Type, transmits)                                                      \
    if (HAS_LOBE(NAME) && transmits) passes = passes | b.has.name;
    LOBES(ADD_LOBE)
#undef ADD_LOBE
    return passes;
}

// Whether it has nothing but smooth lobes, so that what is seen in it is sharp.
INLINE mask bsdf_is_mirror(Bsdf b) {
    mask smooth = (mask)(0), rough = (mask)(0);
#define SORT_LOBE(NAME, name, Type, transmits)                                                     \
    if (HAS_LOBE(NAME)) {                                                                          \
        const mask there = b.has.name & (b.probability.name > 0.0f);                               \
        smooth = smooth | (there & name##_is_smooth(b.name));                                      \
        rough = rough | (there & !name##_is_smooth(b.name));                                       \
    }
    LOBES(SORT_LOBE)
#undef SORT_LOBE
    return smooth & !rough;
}

// The diffuse share of bsdf_eval's `value`.
INLINE real3 bsdf_diffuse_share(Bsdf b, real3 wo, real3 wi, real3 value) {
    if (!HAS_LOBE(DIFFUSE)) return zero3();
    real3 own = diffuse_eval(b.diffuse, wo, wi, b.has.diffuse).value;
    if (HAS_LAYERS) own = scale3(own, b.through.diffuse);
    return make3(share_of(own.x, value.x), share_of(own.y, value.y), share_of(own.z, value.z));
}

// The index below over the index above, where light is refracted; 1 elsewhere.
INLINE real bsdf_eta(Bsdf b) {
    const real one = (real)(1.0f);
    return HAS_LOBE(DIELECTRIC) ? choose(b.has.dielectric, b.dielectric.eta, one) : one;
}

#endif
