// Light from infinity: a constant, or an equirectangular map. Row 0 of the map is straight up (+Y),
// its centre column is -Z, +X lies to the right of it.
#ifndef ONDE_SHADE_ENVIRONMENT_H
#define ONDE_SHADE_ENVIRONMENT_H

#include "math/sampling.h"
#include "shade/texture.h"

// What comes from a direction, and the density with which environment_sample takes it.
typedef struct {
    real3 radiance;
    real pdf;
} FarLight;

#if ONDE_ENVIRONMENT

INLINE real2 environment_uv(SceneView view, real3 d) {
    const real turns = angle_turns(d.x, -d.z) + (0.5f + view.frame->environment_rotation);
    const real elevation = angle_turns(sqrt(fma(d.x, d.x, d.z * d.z)), d.y); // from +Y, [0, 0.5]
    return make2(turns - floor(turns), 2.0f * elevation);
}

INLINE real3 environment_direction(SceneView view, real2 uv) {
    const SineCosine a = sincos_turns(uv.x - (0.5f + view.frame->environment_rotation));
    const SineCosine e = sincos_turns(0.5f * uv.y);
    return make3(a.sine * e.sine, e.cosine, -a.cosine * e.sine);
}

INLINE real3 environment_pixel(SceneView view, natural i) {
    return make3(gather_real(view.environment, i * 3u), gather_real(view.environment, i * 3u + 1u),
                 gather_real(view.environment, i * 3u + 2u));
}

// The four pixels around a place on the map, by row, and the weights of the second ones.
typedef struct {
    real3 pixel[2][2];
    natural row[2];
    real across, down;
} MapCell;

INLINE MapCell environment_cell(SceneView view, real3 d) {
    const real2 uv = environment_uv(view, d);
    const natural width = (natural)(view.frame->environment_width);
    const natural height = (natural)(view.frame->environment_height);
    const TexelPair x = texel_pair(uv.x, width, (natural)(WRAP_REPEAT), (natural)(FILTER_LINEAR));
    const TexelPair y = texel_pair(uv.y, height, (natural)(WRAP_CLAMP), (natural)(FILTER_LINEAR));
    const natural row0 = y.first * width, row1 = y.second * width;
    const MapCell cell = {
        {{environment_pixel(view, row0 + x.first), environment_pixel(view, row0 + x.second)},
         {environment_pixel(view, row1 + x.first), environment_pixel(view, row1 + x.second)}},
        {y.first, y.second},
        x.fraction,
        y.fraction};
    return cell;
}

INLINE real3 map_radiance(SceneView view, MapCell c) {
    const real3 top = mix3(c.pixel[0][0], c.pixel[0][1], c.across);
    const real3 bottom = mix3(c.pixel[1][0], c.pixel[1][1], c.across);
    return mul3(uniform3(view.frame->environment_radiance), mix3(top, bottom, c.down));
}

// Radiance that arrives from direction d (unit).
INLINE real3 environment_radiance(SceneView view, real3 d) {
    if (view.frame->environment_width == 0) return uniform3(view.frame->environment_radiance);
    return map_radiance(view, environment_cell(view, d));
}

// Density per solid angle over density per map area: 1 / (2 pi^2 sin).
INLINE real equirectangular_jacobian(real sine) {
    return 0.5f * INV_PI * INV_PI / max_real(sine, (real)(1e-6f));
}

// The probability of a pixel, times what all pixels have in common, in the tables of `which`. A
// pixel's weight is its brightness times its solid angle. Where BSDFs are sampled too, the
// brightness is taken less by a floor, at least 0: what is dim they find well enough, and samples
// of the map are for what is bright (Karlik et al. 2019, MIS Compensation).
INLINE real pixel_weight(SceneView view, real3 pixel, uint which) {
    const float scale = view.frame->environment_scale[which];
    const float floor = which == MAP_COMPENSATED ? view.frame->environment_floor * scale : 0.0f;
    const real brightness =
        fma(pixel.z, (real)(scale), fma(pixel.y, (real)(scale), pixel.x * scale));
    return max_real(brightness - floor, (real)(0.0f));
}

// Of the polar angle of a row's middle; counted from the nearer pole, where it needs its digits.
INLINE real row_sine(SceneView view, natural row) {
    const uint height = view.frame->environment_height;
    const natural below = (natural)(height - 1u) - row;
    const natural from_pole = choose(row < below, row, below);
    return sincos_turns((to_real(from_pole) + 0.5f) * (0.5f / (float)height)).sine;
}

// The map is looked up bilinearly: it is a sum of tents, one about the middle of each pixel. So is
// this density, with the pixels' probabilities for heights, and proportional to the map's.
INLINE real map_pdf(SceneView view, MapCell c, real3 d, uint which) {
    const real p0 = pixel_weight(view, c.pixel[0][0], which);
    const real p1 = pixel_weight(view, c.pixel[1][0], which);
    const real top =
        fma(pixel_weight(view, c.pixel[0][1], which) - p0, c.across, p0) * row_sine(view, c.row[0]);
    const real bottom =
        fma(pixel_weight(view, c.pixel[1][1], which) - p1, c.across, p1) * row_sine(view, c.row[1]);
    const real sine = sqrt(fma(d.x, d.x, d.z * d.z));
    return fma(bottom - top, c.down, top) * equirectangular_jacobian(sine);
}

INLINE FarLight environment_look(SceneView view, real3 d, uint which) {
    FarLight far;
    far.radiance = uniform3(view.frame->environment_radiance);
    far.pdf = (real)(PDF_SPHERE);
    if (view.frame->environment_width == 0) return far;
    const MapCell cell = environment_cell(view, d);
    far.radiance = map_radiance(view, cell);
    far.pdf = map_pdf(view, cell, d, which);
    return far;
}

// A pixel by its probability, and what is left of the numbers that chose it: a column and row are
// drawn uniformly, then kept or exchanged by the alias table.
typedef struct {
    natural index;
    real2 rest;
} DrawnPixel;

INLINE DrawnPixel draw_pixel(SceneView view, real2 u, uint which) {
    const uint width = view.frame->environment_width, height = view.frame->environment_height;
    const real x = u.x * (float)width, y = u.y * (float)height;
    const real column = min_real(floor(x), (real)(width - 1.0f));
    const real line = min_real(floor(y), (real)(height - 1.0f));
    const natural drawn = as_natural(to_integer(line)) * width + as_natural(to_integer(column));
    const natural entry = drawn * MAP_TABLES + which;
    const real fraction = x - column;
    const real below = RECORD(view.environment_alias, entry, AliasRecord, below);
    const mask stays = fraction < below;
    const real rest = choose(stays, fraction / max_real(below, (real)(1e-9f)),
                             (fraction - below) / max_real(1.0f - below, (real)(1e-9f)));
    DrawnPixel chosen;
    chosen.index =
        choose(stays, drawn, RECORD_NATURAL(view.environment_alias, entry, AliasRecord, alias));
    chosen.rest = make2(clamp_real(rest, 0.0f, 1.0f), y - line);
    return chosen;
}

// A direction by the tables of `which`: a pixel, and a point of its tent. Tents go on around the
// map; at the poles they are mirrored, which is what the clamped lookup weighs.
INLINE real3 environment_sample(SceneView view, real2 u, uint which) {
    if (view.frame->environment_width == 0) return sample_sphere(u);
    const uint width = view.frame->environment_width, height = view.frame->environment_height;
    const DrawnPixel chosen = draw_pixel(view, u, which);
    const natural row = chosen.index / width;
    const real column = to_real(chosen.index - row * width);
    const real x = (column + 0.5f + sample_tent(chosen.rest.x)) / (float)width;
    const real y = fabs(to_real(row) + 0.5f + sample_tent(chosen.rest.y)) / (float)height;
    return environment_direction(view, make2(x, choose(y > 1.0f, 2.0f - y, y)));
}

#else

INLINE real3 environment_radiance(SceneView view, real3 d) {
    return zero3();
}
INLINE FarLight environment_look(SceneView view, real3 d, uint which) {
    FarLight far;
    far.radiance = zero3();
    far.pdf = (real)(1.0f);
    return far;
}
INLINE real3 environment_sample(SceneView view, real2 u, uint which) {
    return sample_sphere(u);
}

#endif

#endif
