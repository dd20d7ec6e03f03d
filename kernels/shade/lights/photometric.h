// A point that shines by direction as a profile says: that of a lamp which has been measured.
#ifndef ONDE_SHADE_LIGHTS_PHOTOMETRIC_H
#define ONDE_SHADE_LIGHTS_PHOTOMETRIC_H

#include "shade/lights/point.h"
#include "shared/profile.h"

typedef struct {
    natural first; // word
    natural rows, columns;
} Profile;

// Lanes with lights of other types get the first one.
INLINE Profile light_profile(SceneView view, natural light) {
    const natural kind = RECORD_NATURAL(view.lights, light, LightRecord, kind);
    const natural first = RECORD_NATURAL(view.lights, light, LightRecord, surface);
    Profile p;
    p.first = choose(kind == (uint)LIGHT_PHOTOMETRIC, first, (natural)(0u));
    p.rows = gather_natural(view.profiles, p.first + PROFILE_ROWS);
    p.columns = gather_natural(view.profiles, p.first + PROFILE_COLUMNS);
    return p;
}

INLINE real profile_node(SceneView view, Profile p, natural row, natural column) {
    return as_real(
        gather_natural(view.profiles, p.first + PROFILE_NODES + row * p.columns + column));
}

INLINE real profile_word(SceneView view, Profile p, natural cell, uint which) {
    const natural cells = p.first + PROFILE_NODES + (p.rows + 1u) * p.columns;
    return as_real(gather_natural(view.profiles, cells + cell * PROFILE_CELL_WORDS + which));
}

// In a direction of the profile's space, from the light: bilinear between nodes.
INLINE real profile_value(SceneView view, Profile p, real3 d) {
    const real polar = 2.0f * angle_turns(sqrt(fma(d.x, d.x, d.y * d.y)), d.z);
    const real turns = angle_turns(-d.y, d.x);
    const real y = polar * to_real(p.rows), x = (turns - floor(turns)) * to_real(p.columns);
    const real top = min_real(floor(y), to_real(p.rows - 1u));
    const real left = min_real(floor(x), to_real(p.columns - 1u));
    // Dead lanes may have numbers that are none.
    const natural row = min(as_natural(to_integer(top)), p.rows - 1u);
    const natural column = min(as_natural(to_integer(left)), p.columns - 1u);
    const natural next = choose(column + 1u == p.columns, (natural)(0u), column + 1u);
    const real across = x - left, down = y - top;
    const real v0 = profile_node(view, p, row, column);
    const real v1 = profile_node(view, p, row + 1u, column);
    const real upper = fma(profile_node(view, p, row, next) - v0, across, v0);
    const real lower = fma(profile_node(view, p, row + 1u, next) - v1, across, v1);
    return fma(lower - upper, down, upper);
}

// A direction of the profile's space, by the cells' probabilities.
typedef struct {
    real3 direction;
    real pdf;
} ProfileSample;

INLINE natural draw_cell(SceneView view, Profile p, real2* u) {
    const real x = u->x * to_real(p.columns), y = u->y * to_real(p.rows);
    const real column = min_real(floor(x), to_real(p.columns - 1u));
    const real row = min_real(floor(y), to_real(p.rows - 1u));
    const natural drawn = as_natural(to_integer(row)) * p.columns + as_natural(to_integer(column));
    const real fraction = x - column;
    const real below = profile_word(view, p, drawn, PROFILE_BELOW);
    const mask stays = fraction < below;
    const real rest = choose(stays, fraction / max_real(below, (real)(1e-9f)),
                             (fraction - below) / max_real(1.0f - below, (real)(1e-9f)));
    *u = make2(clamp_real(rest, 0.0f, 1.0f), y - row);
    return choose(stays, drawn, as_natural(profile_word(view, p, drawn, PROFILE_ALIAS)));
}

INLINE ProfileSample profile_sample(SceneView view, Profile p, real2 u) {
    const natural cell = draw_cell(view, p, &u);
    const natural row = cell / p.columns;
    const real i = to_real(row), j = to_real(cell - row * p.columns);
    const real step = 0.25f / to_real(p.rows); // half of a row, in turns
    const real sine = sincos_turns(i * step).sine;
    const real opening = 2.0f * sine * sine; // 1 - cos of the row's upper edge
    const real height = 2.0f * sincos_turns(fma(i, (real)(2.0f), (real)(1.0f)) * step).sine *
                        sincos_turns(step).sine; // of the row, by cosine
    const real below = min_real(fma(u.y, height, opening), (real)(2.0f));
    const real radius = safe_sqrt(below * (2.0f - below));
    const SineCosine around = sincos_turns((j + u.x) / to_real(p.columns));
    ProfileSample s;
    s.direction = make3(radius * around.cosine, -(radius * around.sine), 1.0f - below);
    s.pdf = profile_word(view, p, cell, PROFILE_PMF) * to_real(p.columns) / (2.0f * PI * height);
    return s;
}

// A vector of the profile's space in the world, or for sign -1 the other way.
INLINE real3 profile_turn(SceneView view, natural light, real3 v, float sign) {
    const real3 q = scale3(LIGHT_FIELD3(view, light, photometric.turn), (real)(sign));
    const real w = LIGHT_FIELD(view, light, photometric.turn[3]);
    return madd3(cross3(q, madd3(v, w, cross3(q, v))), (real)(2.0f), v);
}

INLINE LightSample photometric_light_sample(SceneView view, natural light, real3 from, real2 u) {
    LightSample s = sample_point(LIGHT_FIELD3(view, light, photometric.position),
                                 LIGHT_FIELD3(view, light, photometric.intensity), from);
    const real3 leaving = profile_turn(view, light, negate3(s.direction), -1.0f);
    const real share = profile_value(view, light_profile(view, light), leaving);
    s.radiance = scale3(s.radiance, share);
    s.valid = s.valid & (share > 0.0f);
    return s;
}
INLINE real photometric_light_pdf(SceneView view, natural light, real3 from, real3 direction,
                                  real t, Surface s) {
    return (real)(0.0f);
}
INLINE Emission photometric_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                       natural light, real pmf, EmissionNumbers u) {
    const Profile profile = light_profile(view, light);
    const ProfileSample s = profile_sample(view, profile, u.direction);
    const real weight = profile_value(view, profile, s.direction) / (pmf * s.pdf);
    Emission e = no_emission();
    e.position = LIGHT_FIELD3(view, light, photometric.position);
    e.direction = profile_turn(view, light, s.direction, 1.0f);
    e.power = scale3(LIGHT_FIELD3(view, light, photometric.intensity),
                     choose(s.pdf > 0.0f, weight, (real)(0.0f)));
    return e;
}

#endif
