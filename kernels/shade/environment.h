// Light from infinity: a constant, or an equirectangular map. Row 0 of the map is straight up (+Y),
// its centre column is -Z, +X lies to the right of it.
#ifndef ONDE_SHADE_ENVIRONMENT_H
#define ONDE_SHADE_ENVIRONMENT_H

#include "math/sampling.h"
#include "shade/texture.h"

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
    natural pixel[2][2];
    real across, down;
} MapCell;

INLINE MapCell environment_cell(SceneView view, real3 d) {
    const real2 uv = environment_uv(view, d);
    const natural width = (natural)(view.frame->environment_width);
    const natural height = (natural)(view.frame->environment_height);
    const TexelPair x = texel_pair(uv.x, width, (natural)(WRAP_REPEAT), (natural)(FILTER_LINEAR));
    const TexelPair y = texel_pair(uv.y, height, (natural)(WRAP_CLAMP), (natural)(FILTER_LINEAR));
    const natural row0 = y.first * width, row1 = y.second * width;
    const MapCell cell = {{{row0 + x.first, row0 + x.second}, {row1 + x.first, row1 + x.second}},
                          x.fraction,
                          y.fraction};
    return cell;
}

INLINE real3 environment_map(SceneView view, real3 d) {
    const MapCell c = environment_cell(view, d);
    const real3 top = mix3(environment_pixel(view, c.pixel[0][0]),
                           environment_pixel(view, c.pixel[0][1]), c.across);
    const real3 bottom = mix3(environment_pixel(view, c.pixel[1][0]),
                              environment_pixel(view, c.pixel[1][1]), c.across);
    return mix3(top, bottom, c.down);
}

// Radiance that arrives from direction d (unit).
INLINE real3 environment_radiance(SceneView view, real3 d) {
    const real3 scale = uniform3(view.frame->environment_radiance);
    if (view.frame->environment_width == 0) return scale;
    return mul3(scale, environment_map(view, d));
}

// Density per solid angle over density per map area: 1 / (2 pi^2 sin).
INLINE real equirectangular_jacobian(real sine) {
    return 0.5f * INV_PI * INV_PI / max_real(sine, (real)(1e-6f));
}

INLINE real environment_pmf(SceneView view, natural pixel) {
    return RECORD(view.environment_alias, pixel, AliasRecord, pmf);
}

// The map is looked up bilinearly: it is a sum of tents, one about the middle of each pixel. So is
// this density, with the pixels' probabilities for heights, and proportional to the map's.
INLINE real environment_pdf(SceneView view, real3 d) {
    if (view.frame->environment_width == 0) return (real)(PDF_SPHERE);
    const uint width = view.frame->environment_width, height = view.frame->environment_height;
    const MapCell c = environment_cell(view, d);
    const real p0 = environment_pmf(view, c.pixel[0][0]);
    const real top = fma(environment_pmf(view, c.pixel[0][1]) - p0, c.across, p0);
    const real p1 = environment_pmf(view, c.pixel[1][0]);
    const real bottom = fma(environment_pmf(view, c.pixel[1][1]) - p1, c.across, p1);
    const real sine = sqrt(fma(d.x, d.x, d.z * d.z));
    return fma(bottom - top, c.down, top) * ((float)width * (float)height) *
           equirectangular_jacobian(sine);
}

// A pixel by its probability, and what is left of the numbers that chose it: a column and row are
// drawn uniformly, then kept or exchanged by the alias table.
typedef struct {
    natural index;
    real2 rest;
} DrawnPixel;

INLINE DrawnPixel draw_pixel(SceneView view, real2 u) {
    const uint width = view.frame->environment_width, height = view.frame->environment_height;
    const real x = u.x * (float)width, y = u.y * (float)height;
    const real column = min_real(floor(x), (real)(width - 1.0f));
    const real line = min_real(floor(y), (real)(height - 1.0f));
    const natural drawn = as_natural(to_integer(line)) * width + as_natural(to_integer(column));
    const real fraction = x - column;
    const real below = RECORD(view.environment_alias, drawn, AliasRecord, below);
    const mask stays = fraction < below;
    const real rest = choose(stays, fraction / max_real(below, (real)(1e-9f)),
                             (fraction - below) / max_real(1.0f - below, (real)(1e-9f)));
    DrawnPixel chosen;
    chosen.index =
        choose(stays, drawn, RECORD_NATURAL(view.environment_alias, drawn, AliasRecord, alias));
    chosen.rest = make2(clamp_real(rest, 0.0f, 1.0f), y - line);
    return chosen;
}

// A direction with density environment_pdf: a pixel, and a point of its tent. Tents go on around
// the map; at the poles they are mirrored, which is what the clamped lookup weighs.
INLINE real3 environment_sample(SceneView view, real2 u) {
    if (view.frame->environment_width == 0) return sample_sphere(u);
    const uint width = view.frame->environment_width, height = view.frame->environment_height;
    const DrawnPixel chosen = draw_pixel(view, u);
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
INLINE real environment_pdf(SceneView view, real3 d) {
    return (real)(1.0f);
}
INLINE real3 environment_sample(SceneView view, real2 u) {
    return sample_sphere(u);
}

#endif

#endif
