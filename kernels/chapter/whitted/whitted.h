// The chapter's estimator (docs/whitted.md): what a ray of the tree sees at its hit, and which rays
// start there. It knows nothing of queues, nor of the order in which a tree is visited.
#ifndef ONDE_CHAPTER_WHITTED_WHITTED_H
#define ONDE_CHAPTER_WHITTED_WHITTED_H

#include "chapter/whitted/source.h"
#include "shade/camera.h"
#include "shade/connection.h"
#include "shade/environment.h"
#include "shade/fresnel.h"
#include "shade/material.h"

// Whether some material lets light through, and whether some splits white light; the host compiles
// only what the scene needs.
#ifndef ONDE_TRANSLUCENT
    #define ONDE_TRANSLUCENT 1
#endif
#ifndef ONDE_DISPERSION
    #define ONDE_DISPERSION 1
#endif

typedef struct {
    __global const WhittedRecord* settings;
    __global const PhongRecord* phong;
    __global const SourceRecord* sources;
} WhittedView;

COLUMNS_TYPE(WhittedRay, WHITTED_COLUMNS);
COLUMNS_CHOICE(WhittedRay, WHITTED_COLUMNS)

// The most children of a node.
INLINE uint most_children(WhittedView w) {
#if ONDE_DISPERSION
    return 1 + w.settings->wavelengths;
#elif ONDE_TRANSLUCENT
    return 2;
#else
    return 1;
#endif
}

INLINE WhittedRay whitted_root(__global const FrameRecord* frame, natural pixel, natural sample) {
    const real2 offset = sample_offset(sample);
    const CameraRay camera = camera_ray_through(frame, to_real(pixel & 0xffffu) + offset.x,
                                                to_real(pixel >> 16) + offset.y);
    WhittedRay ray;
    ray.origin = camera.origin;
    ray.direction = camera.direction;
    ray.factor = splat3((real)(1.0f));
#if ONDE_PROJECTIONS
    ray.factor = choose(camera.shows, ray.factor, zero3());
#endif
    ray.product = (real)(1.0f);
    ray.passed = (real)(0.0f);
    ray.kind = ray.level = (natural)(0u);
    ray.color = zero3();
    return ray;
}

// a (+) b: the sum, cut at 1 where the settings say so.
INLINE real3 add_light(WhittedView w, real3 a, real3 b) {
    const real3 sum = add3(a, b);
    if (!w.settings->saturate) return sum;
    const real one = (real)(1.0f);
    return make3(min_real(sum.x, one), min_real(sum.y, one), min_real(sum.z, one));
}

// A hit as the estimator sees it.
typedef struct {
    Surface surface;
    real3 view;        // unit, back along the ray
    real t;            // length of the ray
    mask found, alive; // alive: its product of factors is above epsilon
    real product;
    natural level;
} WhittedVertex;

INLINE real phong_value(WhittedView w, WhittedVertex v, uint word) {
    return gather_real((__global const float*)w.phong,
                       v.surface.material * (uint)(sizeof(PhongRecord) / 4) + word);
}
#define PHONG(w, v, field) phong_value(w, v, (uint)(__builtin_offsetof(PhongRecord, field) / 4))

INLINE WhittedVertex whitted_vertex(SceneView view, WhittedView w, WhittedRay ray, Hits hit,
                                    mask lanes) {
    WhittedVertex v;
    v.found = lanes & (hit.primitive != BVH_NONE);
    v.surface = surface_at(view, ray.origin, ray.direction, hit, v.found);
    v.view = negate3(ray.direction);
    v.level = ray.level;
    v.t = choose(v.found, hit.t + ray.passed, (real)(0.0f));
    const mask takes = v.found & ((ray.kind & KIND_TAKES_FACTOR) != 0u);
    v.product = ray.product * choose(takes, PHONG(w, v, reflection), (real)(1.0f));
    v.alive = lanes & (v.product > w.settings->epsilon);
    return v;
}

// The factor of the ray's colour in its parent's, now that its hit is known.
INLINE real3 arrival_factor(WhittedView w, WhittedRay ray, WhittedVertex v) {
    const mask takes = v.found & ((ray.kind & KIND_TAKES_FACTOR) != 0u);
    real scale = choose(takes, PHONG(w, v, reflection), (real)(1.0f));
    if (w.settings->distance_falloff) scale = choose(v.found, scale / (v.t * v.t), scale);
    return scale3(ray.factor, scale);
}

INLINE real3 phong_color(SceneView view, WhittedView w, WhittedVertex v) {
    real3 color = make3(PHONG(w, v, color[0]), PHONG(w, v, color[1]), PHONG(w, v, color[2]));
#if ONDE_VERTEX_COLORS
    color = mul3(color, v.surface.tint);
#endif
#if ONDE_TEXTURES
    return mul3(color, texture_color(view, as_natural(PHONG(w, v, texture)), v.surface.uv));
#else
    return color;
#endif
}

INLINE real3 mirror_direction(WhittedVertex v) {
    const real3 n = v.surface.normal;
    return madd3(n, 2.0f * dot3(n, v.view), negate3(v.view));
}

// Where a ray in direction d leaves the vertex.
INLINE AdvancedOrigin whitted_exit(WhittedVertex v, real3 d) {
    AdvancedOrigin exit =
        advance_origin(v.surface.position, v.surface.geometric, d, v.surface.lift);
#if ONDE_CURVED
    const mask over = leaves_curve(v.surface, d);
    exit.origin = choose(over, curve_exit(v.surface), exit.origin);
    exit.passed = choose(over, (real)(0.0f), exit.passed);
#endif
    return exit;
}

// max(r.v, 0)^e, with r the mirror image of the direction to the sample; cosine: n.l. As r and v
// are unit, r.v = 1 - |r - v|^2 / 2, whose digits a large exponent needs.
INLINE real sample_highlight(WhittedView w, WhittedVertex v, SourceSample s, real cosine) {
    const real3 r = madd3(v.surface.normal, 2.0f * cosine, negate3(s.direction));
    const real3 apart = sub3(r, v.view);
    return power_below_one(min_real(0.5f * dot3(apart, apart), (real)(1.0f)),
                           PHONG(w, v, exponent));
}

// What one sample of a source adds to the mean over its samples, if it arrives: a factor of the
// source's intensity times the object's colour.
INLINE Connection sample_connection(WhittedView w, WhittedVertex v,
                                    __global const SourceRecord* source, real2 uv, mask lanes) {
    const SourceSample s = source_sample(source, uv, v.surface.position);
    const real cosine = dot3(v.surface.normal, s.direction);
    const mask lit = lanes & s.lit & (cosine > 0.0f);
    real phong = PHONG(w, v, diffuse) * cosine;
    const real specular = PHONG(w, v, specular);
    if_any (lit & (specular > 0.0f))
        phong = fma(specular, sample_highlight(w, v, s, cosine), phong);
    Connection c;
    c.origin = whitted_exit(v, s.direction).origin;
    const mask finite = s.distance < SOURCE_INFINITY;
    const real3 to = sub3(s.target, c.origin);
    const real length = length3(to);
    c.direction = choose(finite, scale3(to, 1.0f / length), s.direction);
    c.distance = choose(finite, length * SHADOW_SHORTENING, (real)(SOURCE_INFINITY));
    c.distance = choose(lit & (phong > 0.0f), c.distance, (real)(0.0f));
    c.value = make3(phong, (real)(0.0f), (real)(0.0f));
    c.target = (natural)(0u);
    return c;
}

// Sample `k` of a source: the middle of its cell of the grid, moved by `offset` in [0, 1).
INLINE real2 grid_point(__global const SourceRecord* source, uint k, real2 offset) {
    const uint side = source->samples;
    const float step = 1.0f / (float)side;
    return make2(((float)(k % side) + offset.x) * step, ((float)(k / side) + offset.y) * step);
}

// What a source adds whose samples have added up to `sum`.
INLINE real3 source_light(__global const SourceRecord* source, real sum) {
    const uint side = source->samples;
    return scale3(uniform3(source->intensity), sum / (float)(side * side));
}

INLINE real3 ambient_light(WhittedView w, WhittedVertex v, real3 color) {
    return scale3(mul3(color, uniform3(w.settings->ambient)), PHONG(w, v, ambient));
}

INLINE real3 surface_emission(SceneView view, WhittedVertex v, mask lanes) {
    const mask emits = lanes & material_emits(view, v.surface.material, v.surface.front);
    real3 shown = choose(emits, material_emission(view, v.surface.material, v.surface.uv), zero3());
    if (HAS_UNLIT) {
        const mask unlit = lanes & is_unlit(view, v.surface.material);
        if_any (unlit) shown = choose(unlit, add3(shown, material_color(view, v.surface)), shown);
    }
    return shown;
}

INLINE real3 whitted_background(SceneView view, WhittedView w, real3 direction) {
    if (w.settings->has_background) return uniform3(w.settings->background);
    return environment_radiance(view, direction);
}

// Where surfaces are lit, and where the background is seen.
INLINE mask lit_lanes(WhittedVertex v, mask lanes) {
    return lanes & v.alive & v.found;
}
INLINE mask missed_lanes(WhittedVertex v, mask lanes) {
    return lanes & v.alive & !v.found;
}

// A child of a node, where `exists`.
typedef struct {
    WhittedRay ray;
    mask exists;
} WhittedChild;

// Indices before over behind the surface.
INLINE real index_ratio(WhittedVertex v, real ior) {
    return choose(v.surface.front, 1.0f / ior, ior);
}

INLINE WhittedChild make_child(WhittedView w, WhittedVertex v, real3 direction, real3 factor,
                               natural kind, mask exists) {
    WhittedChild child;
    const AdvancedOrigin exit = whitted_exit(v, direction);
    child.ray.origin = exit.origin;
    child.ray.passed = exit.passed;
    child.ray.direction = direction;
    child.ray.factor = factor;
    child.ray.product = v.product * max_component3(factor);
    child.ray.kind = kind;
    child.ray.level = v.level + 1u;
    child.ray.color = zero3();
    child.exists = exists & v.alive & v.found & (child.ray.product > w.settings->epsilon) &
                   (child.ray.product > 0.0f);
    return child;
}

// Fresnel's share of reflection, where the settings ask for it and light goes through; else 0.
INLINE real mirrored_share(WhittedView w, WhittedVertex v) {
#if ONDE_TRANSLUCENT
    if (!w.settings->fresnel) return (real)(0.0f);
    const real cosine = clamp_real(dot3(v.surface.normal, v.view), 0.0f, 1.0f);
    return fresnel_dielectric(cosine, 1.0f / index_ratio(v, PHONG(w, v, ior)));
#else
    return (real)(0.0f);
#endif
}

INLINE WhittedChild mirror_child(WhittedView w, WhittedVertex v, natural kind) {
    const real own = PHONG(w, v, reflection);
    const real share = PHONG(w, v, transmission) * mirrored_share(w, v);
    const uint by_source = w.settings->source_reflectivity;
    // By the chapter's convention the surface that is met has the factor.
    real factor = own + share;
    if (by_source) factor = choose(share > 0.0f, share, (real)(1.0f));
    factor = min_real(factor, (real)(1.0f));
    const natural met = (natural)(by_source ? KIND_TAKES_FACTOR : 0u);
    return make_child(w, v, mirror_direction(v), splat3(factor), (kind & KIND_WAVELENGTH) | met,
                      factor > 0.0f);
}

// The refracted direction or, beyond the critical angle, the mirrored one. ratio: n1 / n2.
INLINE real3 transmitted_direction(WhittedVertex v, real ratio) {
    const real3 n = v.surface.normal;
    const real cosine = dot3(n, v.view);
    const real sine2 = ratio * ratio * (1.0f - cosine * cosine);
    const real3 refracted =
        madd3(n, fma(ratio, cosine, -safe_sqrt(1.0f - sine2)), scale3(v.view, -ratio));
    return choose(sine2 > 1.0f, mirror_direction(v), normalize3(refracted));
}

// The transmitted child; `split` counts the wavelengths of a white ray, from 0.
INLINE WhittedChild transmitted_child(WhittedView w, WhittedVertex v, natural kind, uint split) {
    const natural own = kind & KIND_WAVELENGTH;
    real ior = PHONG(w, v, ior);
    real3 filter = splat3((real)(1.0f));
    natural wavelength = own;
    mask exists = PHONG(w, v, transmission) > 0.0f;
#if ONDE_DISPERSION
    const real dispersion = PHONG(w, v, dispersion);
    const mask disperses = dispersion > 0.0f, splits = disperses & (own == 0u);
    wavelength = choose(splits, (natural)(split + 1u), own);
    const natural index = choose(wavelength == 0u, (natural)(0u), wavelength - 1u);
    const real bend = gather_real(w.settings->bend, index);
    ior = choose(disperses, fma(dispersion, bend, ior), ior);
    filter = choose(splits, uniform3(w.settings->filter + 3 * split), filter);
    exists = exists & (splits | ((natural)(split) == 0u));
#endif
    const real factor = PHONG(w, v, transmission) * (1.0f - mirrored_share(w, v));
    const real3 direction = transmitted_direction(v, index_ratio(v, ior));
    return make_child(w, v, direction, scale3(filter, factor), wavelength,
                      exists & (factor > 0.0f));
}

// Child `i` of most_children(), in the order in which they are added up. kind: the node's ray's.
INLINE WhittedChild whitted_child(WhittedView w, WhittedVertex v, natural kind, uint i) {
#if ONDE_TRANSLUCENT
    if (i > 0) return transmitted_child(w, v, kind, i - 1);
#endif
    return mirror_child(w, v, kind);
}

#endif
