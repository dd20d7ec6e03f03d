// Choosing one of many lights by what each may send to a point: down a tree of bounds of lights
// (Conty Estevez and Kulla 2018, Importance Sampling of Many Lights with Adaptive Tree Splitting).
// Branches whose lights all look away, or lie below the receiver's horizon, are taken only where
// those beside them do so too.
#ifndef ONDE_SHADE_LIGHT_TREE_H
#define ONDE_SHADE_LIGHT_TREE_H

#include "math/elementary.h"
#include "shade/lights/light_type.h"

// A light, and the probability with which it was chosen.
typedef struct {
    natural light;
    real pmf;
} LightChoice;

#if ONDE_LIGHT_TREE

    #define BRANCH(view, branch, field) RECORD(view.light_tree, branch, LightBranch, field)
    #define BRANCH_WORD(view, branch, field)                                                       \
        RECORD_NATURAL(view.light_tree, branch, LightBranch, field)
    #define BRANCH3(view, branch, field) RECORD3(view.light_tree, branch, LightBranch, field)

INLINE real upper_number(natural word) {
    return as_real(word & 0xffff0000u);
}
INLINE real lower_number(natural word) {
    return as_real(word << 16);
}

INLINE SineCosine angle_of(real cosine) {
    SineCosine a;
    a.cosine = cosine;
    a.sine = safe_sqrt(1.0f - cosine * cosine);
    return a;
}

// a - b, but not below 0.
INLINE SineCosine angle_beyond(SineCosine a, SineCosine b) {
    const mask within = a.cosine > b.cosine;
    SineCosine left;
    left.cosine = choose(within, (real)(1.0f), fma(a.cosine, b.cosine, a.sine * b.sine));
    left.sine = choose(within, (real)(0.0f), fma(a.sine, b.cosine, -(a.cosine * b.sine)));
    return left;
}

// A bound of what lights of power 1 in the branch send to the receiver: one over the squared
// distance to them, times the cosines that are the best possible for them and, nearly, for the
// receiver. Closer than their sphere's radius it grows no more.
INLINE real branch_reach(SceneView view, natural branch, Receiver at) {
    const natural radius_reach = BRANCH_WORD(view, branch, radius_reach);
    const natural axis_xy = BRANCH_WORD(view, branch, axis_xy);
    const natural axis_z_spread = BRANCH_WORD(view, branch, axis_z_spread);
    const real radius = upper_number(radius_reach);
    const real3 axis =
        make3(upper_number(axis_xy), lower_number(axis_xy), upper_number(axis_z_spread));

    const real3 to = sub3(BRANCH3(view, branch, center), at.position);
    const real distance2 = max_real(dot3(to, to), (real)(1e-30f));
    const real nearness = 1.0f / sqrt(distance2), radius2 = radius * radius;
    const mask inside = distance2 <= radius2;
    SineCosine seen; // half the angle under which the sphere is seen
    seen.sine = min_real(radius * nearness, (real)(1.0f));
    seen.cosine = safe_sqrt(1.0f - seen.sine * seen.sine);

    const SineCosine spread = angle_of(lower_number(axis_z_spread));
    const SineCosine off = angle_beyond(angle_of(-(dot3(axis, to) * nearness)), spread);
    const real leaving = choose(inside, (real)(1.0f), angle_beyond(off, seen).cosine);
    const real arriving = fma(dot3(at.normal, to) * nearness, seen.cosine, seen.sine);
    const mask anywhere = inside | !nonzero3(at.normal);
    const real cosine = leaving * choose(anywhere, (real)(1.0f), clamp_real(arriving, 0.0f, 1.0f));

    const mask shines = leaving > lower_number(radius_reach);
    const real lit = choose(shines, cosine / max_real(distance2, radius2), (real)(0.0f));
    return choose(radius < 0.0f, (real)(1.0f), lit);
}

// The probability of the first branch of a pair; of the second it is 1 - that. Where neither sends
// anything, by their power, so that all lights' probabilities sum to 1.
INLINE real first_branch_pmf(SceneView view, natural pair, Receiver at) {
    const real power1 = BRANCH(view, pair, power), power2 = BRANCH(view, pair + 1u, power);
    const real first = power1 * branch_reach(view, pair, at);
    const real both = first + power2 * branch_reach(view, pair + 1u, at);
    const real blind = power1 / max_real(power1 + power2, (real)(1e-30f));
    return choose(both > 0.0f, first / both, blind);
}

// One light, by one uniform number; what is left of the number is uniform again.
INLINE LightChoice tree_choice(SceneView view, Receiver at, real* u, mask lanes) {
    LightChoice c;
    c.light = (natural)(0u);
    c.pmf = (real)(1.0f);
    natural pair = (natural)(0u);
    while (mask_bits(lanes)) {
        const real first = first_branch_pmf(view, pair, at);
        const mask second = *u >= first;
        const real pmf = choose(second, 1.0f - first, first);
        const real rest = choose(second, *u - first, *u) / pmf;
        c.pmf = choose(lanes, c.pmf * pmf, c.pmf);
        *u = choose(lanes, clamp_real(rest, 0.0f, LARGEST_BELOW_ONE), *u);
        const natural next =
            RECORD_NATURAL(view.light_tree, pair + one_for(second), LightBranch, next);
        const mask leaf = next >= LIGHT_LEAF;
        c.light = choose(lanes & leaf, next - LIGHT_LEAF, c.light);
        lanes = lanes & !leaf;
        pair = choose(lanes, next, pair);
    }
    return c;
}

// The probability with which tree_choice takes a light; 0 outside of the tree.
INLINE real tree_pmf(SceneView view, natural light, Receiver at, mask lanes) {
    real product = (real)(1.0f);
    natural trail = RECORD_NATURAL(view.lights, light, LightRecord, trail);
    natural pair = (natural)(0u);
    const mask outside = trail == LIGHT_OUTSIDE_TREE;
    lanes = lanes & !outside;
    while (mask_bits(lanes)) {
        const natural side = trail & 1u;
        const real first = first_branch_pmf(view, pair, at);
        const real pmf = choose(side != 0u, 1.0f - first, first);
        product = choose(lanes, product * pmf, product);
        const natural next = RECORD_NATURAL(view.light_tree, pair + side, LightBranch, next);
        lanes = lanes & (next < LIGHT_LEAF);
        pair = choose(lanes, next, pair);
        trail = trail >> 1;
    }
    return choose(outside, (real)(0.0f), product);
}

#endif

#endif
