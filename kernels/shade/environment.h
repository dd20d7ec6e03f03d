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

INLINE real3 environment_map(SceneView view, real3 d) {
    const real2 uv = environment_uv(view, d);
    const natural width = (natural)(view.frame->environment_width);
    const natural height = (natural)(view.frame->environment_height);
    const TexelPair x = texel_pair(uv.x, width, (natural)(WRAP_REPEAT));
    const TexelPair y = texel_pair(uv.y, height, (natural)(WRAP_CLAMP));
    const natural row0 = y.first * width, row1 = y.second * width;
    const real3 top = mix3(environment_pixel(view, row0 + x.first),
                           environment_pixel(view, row0 + x.second), x.fraction);
    const real3 bottom = mix3(environment_pixel(view, row1 + x.first),
                              environment_pixel(view, row1 + x.second), x.fraction);
    return mix3(top, bottom, y.fraction);
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

INLINE real environment_pdf(SceneView view, real3 d) {
    if (view.frame->environment_width == 0) return (real)(PDF_SPHERE);
    const real2 uv = environment_uv(view, d);
    const uint width = view.frame->environment_width, height = view.frame->environment_height;
    const real x = min_real(floor(uv.x * (float)width), (real)(width - 1.0f));
    const real y = min_real(floor(uv.y * (float)height), (real)(height - 1.0f));
    const natural i = as_natural(to_integer(y)) * width + as_natural(to_integer(x));
    const real pmf = RECORD(view.environment_alias, i, AliasRecord, pmf);
    const real sine = sqrt(fma(d.x, d.x, d.z * d.z));
    return pmf * ((float)width * (float)height) * equirectangular_jacobian(sine);
}

// A direction with density environment_pdf. A pixel is drawn uniformly by column and row, then kept
// or exchanged by the alias table; what is left of the fractions places the point in the pixel.
INLINE real3 environment_sample(SceneView view, real2 u) {
    if (view.frame->environment_width == 0) return sample_sphere(u);
    const uint width = view.frame->environment_width, height = view.frame->environment_height;
    const real x = u.x * (float)width, y = u.y * (float)height;
    const real column = min_real(floor(x), (real)(width - 1.0f));
    const real line = min_real(floor(y), (real)(height - 1.0f));
    const natural drawn = as_natural(to_integer(line)) * width + as_natural(to_integer(column));
    const real fraction = x - column;
    const real below = RECORD(view.environment_alias, drawn, AliasRecord, below);
    const mask stays = fraction < below;
    const natural i =
        choose(stays, drawn, RECORD_NATURAL(view.environment_alias, drawn, AliasRecord, alias));
    const real across = choose(stays, fraction / max_real(below, (real)(1e-9f)),
                               (fraction - below) / max_real(1.0f - below, (real)(1e-9f)));
    const natural row = i / width;
    const real2 uv =
        make2((to_real(i - row * width) + clamp_real(across, 0.0f, 1.0f)) / (float)width,
              (to_real(row) + (y - line)) / (float)height);
    return environment_direction(view, uv);
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
