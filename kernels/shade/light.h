// Choosing a light, a direction to it or a ray that leaves it, and the densities of that. They
// include the choice of the light. What a type of light is stands in shade/lights/light_type.h;
// which types there are in LIGHT_TYPES.
#ifndef ONDE_SHADE_LIGHT_H
#define ONDE_SHADE_LIGHT_H

#include "math/random.h"
#include "shade/light_tree.h"
#include "shade/lights/directional.h"
#include "shade/lights/disk.h"
#include "shade/lights/environment.h"
#include "shade/lights/photometric.h"
#include "shade/lights/point.h"
#include "shade/lights/sphere.h"
#include "shade/lights/spot.h"
#include "shade/lights/sun.h"
#include "shade/lights/triangle.h"

#define HAS_LIGHT(NAME) (ONDE_LIGHTS >> LIGHT_##NAME & 1u)

// Whether rays that leave the scene may find light.
#define HAS_FAR_LIGHT (ONDE_ENVIRONMENT || HAS_LIGHT(SUN))

// A light by its probability (Vose 1991), from one uniform number; what is left of the number is
// uniform again.
INLINE natural choose_light(SceneView view, real* u) {
    const float count = (float)view.frame->light_count;
    const real scaled = *u * count;
    const real whole = min_real(floor(scaled), (real)(count - 1.0f));
    const natural i = as_natural(to_integer(whole));
    const real below = RECORD(view.lights, i, LightRecord, alias_below), rest = scaled - whole;
    const mask stays = rest < below;
    const real again = choose(stays, rest / max_real(below, (real)(1e-9f)),
                              (rest - below) / max_real(1.0f - below, (real)(1e-9f)));
    *u = clamp_real(again, 0.0f, LARGEST_BELOW_ONE);
    return choose(stays, i, RECORD_NATURAL(view.lights, i, LightRecord, alias));
}

// Among more lights than these little would be left of a number of 24 bits.
#define MOST_SHARING_LIGHTS 1024u

// The same by the first of the two numbers for a point on the light, so that each light keeps a
// whole slab of a stratified square; `choice` is for many lights.
INLINE LightChoice power_choice(SceneView view, real choice, real2* u) {
    const bool shares = view.frame->light_count <= MOST_SHARING_LIGHTS;
    LightChoice c;
    c.light = choose_light(view, shares ? &u->x : &choice);
    c.pmf = RECORD(view.lights, c.light, LightRecord, pmf);
    return c;
}

// The light that a receiver in `lanes` samples.
INLINE LightChoice light_choice(SceneView view, Receiver at, real choice, real2* u, mask lanes) {
#if ONDE_LIGHT_TREE
    return tree_choice(view, at, &u->x, lanes);
#else
    return power_choice(view, choice, u);
#endif
}

INLINE real light_choice_pmf(SceneView view, natural light, Receiver at, mask lanes) {
#if ONDE_LIGHT_TREE
    return tree_pmf(view, light, at, lanes);
#else
    return RECORD(view.lights, light, LightRecord, pmf);
#endif
}

// One light, and a direction to it from a point. The pdf of a delta light is that of the choice
// alone.
INLINE LightSample light_sample(SceneView view, Receiver at, real choice, real2 u, mask lanes) {
    const LightChoice c = light_choice(view, at, choice, &u, lanes);
    const natural kind = RECORD_NATURAL(view.lights, c.light, LightRecord, kind);
    LightSample s = no_light_sample();
#define SAMPLE_LIGHT(NAME, name, Record)                                                           \
    if (HAS_LIGHT(NAME)) {                                                                         \
        const mask own = lanes & (kind == (uint)LIGHT_##NAME);                                     \
        if_any (own) s = choose(own, name##_light_sample(view, c.light, at.position, u), s);       \
    }
    LIGHT_TYPES(SAMPLE_LIGHT)
#undef SAMPLE_LIGHT
    s.pdf *= c.pmf;
#if ONDE_GROUPS
    s.group = RECORD_NATURAL(view.lights, c.light, LightRecord, group);
#endif
    return s;
}

// Light from infinity, for a point of which no other ray looks for it; nothing where another light
// is chosen.
INLINE LightSample far_light_sample(SceneView view, real choice, real2 u, mask lanes) {
    const LightChoice c = power_choice(view, choice, &u);
    const natural kind = RECORD_NATURAL(view.lights, c.light, LightRecord, kind);
    LightSample s = no_light_sample();
    if (HAS_LIGHT(DIRECTIONAL)) {
        const mask own = lanes & (kind == (uint)LIGHT_DIRECTIONAL);
        if_any (own) s = choose(own, directional_light_sample(view, c.light, zero3(), u), s);
    }
    if (HAS_LIGHT(SUN)) {
        const mask own = lanes & (kind == (uint)LIGHT_SUN);
        if_any (own) s = choose(own, sun_light_sample(view, c.light, zero3(), u), s);
    }
    if (HAS_LIGHT(ENVIRONMENT)) {
        const mask own = lanes & (kind == (uint)LIGHT_ENVIRONMENT);
        if_any (own) s = choose(own, sample_environment_light(view, u, MAP_WHOLE), s);
    }
    s.pdf *= c.pmf;
    return s;
}

// The density with which light_sample would have produced the ray from `at` that hit the emitting
// surface `s` at distance t. Lanes whose surface is no light get 0.
INLINE real light_pdf(SceneView view, Receiver at, real3 direction, real t, Surface s, mask lanes) {
    const mask listed = s.light < LIGHT_UNLISTED;
    const natural light = choose(listed, s.light, (natural)(0u));
    const natural kind = RECORD_NATURAL(view.lights, light, LightRecord, kind);
    const real3 from = at.position;
    real pdf = (real)(0.0f);
#define LIGHT_PDF(NAME, name, Record)                                                              \
    if (HAS_LIGHT(NAME)) {                                                                         \
        const mask own = listed & (kind == (uint)LIGHT_##NAME);                                    \
        if_any (own) pdf = choose(own, name##_light_pdf(view, light, from, direction, t, s), pdf); \
    }
    LIGHT_TYPES(LIGHT_PDF)
#undef LIGHT_PDF
    return pdf * light_choice_pmf(view, light, at, lanes & listed);
}

// What comes from the environment in a direction, and the density with which light_sample would
// have taken it.
INLINE FarLight environment_found(SceneView view, real3 direction) {
    const uint light = view.frame->environment_light;
    FarLight far = environment_look(view, direction, MAP_COMPENSATED);
    far.pdf *= light == NO_INDEX ? 0.0f : view.lights[light].pmf;
    return far;
}

// The same of one of the frame's suns.
INLINE FarLight sun_found(SceneView view, uint light, real3 direction) {
    FarLight far = sun_look(view, (natural)(light), direction);
    far.pdf *= view.lights[light].pmf;
    return far;
}

// The start of a ray of light. Needs at least one light.
INLINE Emission light_emit(SceneView view, __global const LightTracingRecord* setup,
                           EmissionNumbers u, mask lanes) {
    const natural light = choose_light(view, &u.choice.x);
    const natural kind = RECORD_NATURAL(view.lights, light, LightRecord, kind);
    const real pmf = RECORD(view.lights, light, LightRecord, pmf);
    Emission e = no_emission();
#define EMIT_LIGHT(NAME, name, Record)                                                             \
    if (HAS_LIGHT(NAME)) {                                                                         \
        const mask own = lanes & (kind == (uint)LIGHT_##NAME);                                     \
        if_any (own) e = choose(own, name##_light_emit(view, setup, light, pmf, u), e);            \
    }
    LIGHT_TYPES(EMIT_LIGHT)
#undef EMIT_LIGHT
    return e;
}

#endif
