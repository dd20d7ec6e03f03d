// Choosing a light, a direction to it or a ray that leaves it, and the densities of that. They
// include the choice of the light. What a type of light is stands in shade/lights/light_type.h;
// which types there are in LIGHT_TYPES.
#ifndef ONDE_SHADE_LIGHT_H
#define ONDE_SHADE_LIGHT_H

#include "math/random.h"
#include "shade/lights/directional.h"
#include "shade/lights/disk.h"
#include "shade/lights/environment.h"
#include "shade/lights/point.h"
#include "shade/lights/sphere.h"
#include "shade/lights/spot.h"
#include "shade/lights/triangle.h"

#define HAS_LIGHT(NAME) (ONDE_LIGHTS >> LIGHT_##NAME & 1u)

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
INLINE natural choose_light_and_rest(SceneView view, real choice, real2* u) {
    if (view.frame->light_count > MOST_SHARING_LIGHTS) return choose_light(view, &choice);
    return choose_light(view, &u->x);
}

// One light, and a direction to it from a point. The pdf of a delta light is that of the choice
// alone. Nothing where the light is of none of `kinds`, bits of a constant.
INLINE LightSample sample_light_of(SceneView view, uint kinds, real3 from, real choice, real2 u,
                                   mask lanes) {
    const natural light = choose_light_and_rest(view, choice, &u);
    const natural kind = RECORD_NATURAL(view.lights, light, LightRecord, kind);
    LightSample s = no_light_sample();
#define SAMPLE_LIGHT(NAME, name, Record)                                                           \
    if (HAS_LIGHT(NAME) && (kinds >> LIGHT_##NAME & 1u)) {                                         \
        const mask own = lanes & (kind == (uint)LIGHT_##NAME);                                     \
        if_any (own) s = choose(own, name##_light_sample(view, light, from, u), s);                \
    }
    LIGHT_TYPES(SAMPLE_LIGHT)
#undef SAMPLE_LIGHT
    s.pdf *= RECORD(view.lights, light, LightRecord, pmf);
#if ONDE_GROUPS
    s.group = RECORD_NATURAL(view.lights, light, LightRecord, group);
#endif
    return s;
}

INLINE LightSample light_sample(SceneView view, real3 from, real choice, real2 u, mask lanes) {
    return sample_light_of(view, ~0u, from, choice, u, lanes);
}

// Light from infinity.
#define INFINITE_LIGHTS (1u << LIGHT_ENVIRONMENT | 1u << LIGHT_DIRECTIONAL)

// The density with which light_sample would have produced the ray from `from` that hit the
// emitting surface `s` at distance t. Lanes whose surface is no light get 0.
INLINE real light_pdf(SceneView view, real3 from, real3 direction, real t, Surface s) {
    const mask listed = s.light < LIGHT_UNLISTED;
    const natural light = choose(listed, s.light, (natural)(0u));
    const natural kind = RECORD_NATURAL(view.lights, light, LightRecord, kind);
    real pdf = (real)(0.0f);
#define LIGHT_PDF(NAME, name, Record)                                                              \
    if (HAS_LIGHT(NAME)) {                                                                         \
        const mask own = listed & (kind == (uint)LIGHT_##NAME);                                    \
        if_any (own) pdf = choose(own, name##_light_pdf(view, light, from, direction, t, s), pdf); \
    }
    LIGHT_TYPES(LIGHT_PDF)
#undef LIGHT_PDF
    return pdf * RECORD(view.lights, light, LightRecord, pmf);
}

// The density of a direction to the environment.
INLINE real environment_found_pdf(SceneView view, real3 direction) {
    const uint light = view.frame->environment_light;
    if (light == NO_INDEX) return (real)(0.0f);
    return environment_pdf(view, direction) * view.lights[light].pmf;
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
