// The chapter's estimator (docs/whitted.md): what a ray of the tree sees at its hit, and which rays
// start there. It knows nothing of queues; engines keep the tree and resolve it.
#ifndef ONDE_CHAPTER_WHITTED_TREE_H
#define ONDE_CHAPTER_WHITTED_TREE_H

#include "chapter/whitted/shadow.h"
#include "chapter/whitted/source.h"
#include "shade/camera.h"
#include "shade/environment.h"
#include "shade/fresnel.h"
#include "shade/material.h"

// Whether some material splits white light.
#ifndef ONDE_DISPERSION
    #define ONDE_DISPERSION 1
#endif

typedef struct {
    __global const WhittedRecord* settings;
    __global const PhongRecord* phong;
    __global const SourceRecord* sources;
} WhittedView;

typedef struct {
    real3 origin, direction;
    real3 factor; // of its colour in its parent's
    real product; // of all factors down to here, largest components
    real passed;  // distance from where it began to the origin, which is clear of the surface
    natural kind;
} TreeRay;

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

INLINE TreeRay tree_root(__global const FrameRecord* frame, natural pixel, natural sample) {
    const real2 offset = sample_offset(sample);
    const CameraRay camera = camera_ray_through(frame, to_real(pixel & 0xffffu) + offset.x,
                                                to_real(pixel >> 16) + offset.y);
    TreeRay ray;
    ray.origin = camera.origin;
    ray.direction = camera.direction;
    ray.factor = splat3((real)(1.0f));
    ray.product = (real)(1.0f);
    ray.passed = (real)(0.0f);
    ray.kind = (natural)(0u);
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
} TreeVertex;

INLINE real phong_value(WhittedView w, TreeVertex v, uint word) {
    return gather_real((__global const float*)w.phong,
                       v.surface.material * (uint)(sizeof(PhongRecord) / 4) + word);
}
#define PHONG(w, v, field) phong_value(w, v, (uint)(__builtin_offsetof(PhongRecord, field) / 4))

INLINE TreeVertex tree_vertex(SceneView view, WhittedView w, TreeRay ray, Hits hit, mask lanes) {
    TreeVertex v;
    v.found = lanes & (hit.primitive != BVH_NONE);
    v.surface = surface_at(view, ray.origin, ray.direction, hit, v.found);
    v.view = negate3(ray.direction);
    v.t = choose(v.found, hit.t + ray.passed, (real)(0.0f));
    const mask takes = v.found & ((ray.kind & KIND_TAKES_FACTOR) != 0u);
    v.product = ray.product * choose(takes, PHONG(w, v, reflection), (real)(1.0f));
    v.alive = lanes & (v.product > w.settings->epsilon);
    return v;
}

// The factor of the ray's colour in its parent's, now that its hit is known.
INLINE real3 arrival_factor(WhittedView w, TreeRay ray, TreeVertex v) {
    const mask takes = v.found & ((ray.kind & KIND_TAKES_FACTOR) != 0u);
    real scale = choose(takes, PHONG(w, v, reflection), (real)(1.0f));
    if (w.settings->distance_falloff) scale = choose(v.found, scale / (v.t * v.t), scale);
    return scale3(ray.factor, scale);
}

INLINE real3 phong_color(SceneView view, WhittedView w, TreeVertex v) {
    const real3 color = make3(PHONG(w, v, color[0]), PHONG(w, v, color[1]), PHONG(w, v, color[2]));
#if ONDE_TEXTURES
    return mul3(color, texture_color(view, as_natural(PHONG(w, v, texture)), v.surface.uv));
#else
    return color;
#endif
}

INLINE real3 mirror_direction(TreeVertex v) {
    const real3 n = v.surface.normal;
    return madd3(n, 2.0f * dot3(n, v.view), negate3(v.view));
}

// Where a ray in direction d leaves the vertex.
INLINE AdvancedOrigin tree_exit(TreeVertex v, real3 d) {
    return advance_origin(v.surface.position, v.surface.geometric, d, v.t);
}

// max(r.v, 0)^e, with r the mirror image of the direction to the sample; cosine: n.l. As r and v
// are unit, r.v = 1 - |r - v|^2 / 2, whose digits a large exponent needs.
INLINE real sample_highlight(WhittedView w, TreeVertex v, SourceSample s, real cosine) {
    const real3 r = madd3(v.surface.normal, 2.0f * cosine, negate3(s.direction));
    const real3 apart = sub3(r, v.view);
    return power_below_one(min_real(0.5f * dot3(apart, apart), (real)(1.0f)),
                           PHONG(w, v, exponent));
}

// What arrives of a sample's light, for the lanes in `bits`.
INLINE real sample_visibility(SceneView view, WhittedView w, TreeVertex v, SourceSample s,
                              uint bits) {
    const real3 origin = tree_exit(v, s.direction).origin;
    const mask finite = s.distance < SOURCE_INFINITY;
    const real3 to = sub3(s.target, origin);
    const real length = length3(to);
    const real3 direction = choose(finite, scale3(to, 1.0f / length), s.direction);
    const real distance = choose(finite, length * SHADOW_SHORTENING, (real)(SOURCE_INFINITY));
    return transmittance(view, w.phong, origin, direction, distance, bits);
}

// What one sample of a source adds, as a factor of its strength times the object's colour.
INLINE real sample_light(SceneView view, WhittedView w, TreeVertex v, SourceSample s, mask lanes,
                         natural* rays) {
    const real cosine = dot3(v.surface.normal, s.direction);
    const mask lit = lanes & s.lit & (cosine > 0.0f);
    const real phong = fma(PHONG(w, v, specular), sample_highlight(w, v, s, cosine),
                           PHONG(w, v, diffuse) * cosine);
    const mask tested = lit & (phong > 0.0f);
    const uint bits = mask_bits(tested);
    if (!bits) return (real)(0.0f);
    *rays += choose(tested, (natural)(1u), (natural)(0u));
    return phong * sample_visibility(view, w, v, s, bits);
}

// The mean over the samples of a source, times its strength.
INLINE real3 source_light(SceneView view, WhittedView w, TreeVertex v,
                          __global const SourceRecord* source, real2 offset, mask lanes,
                          natural* rays) {
    const uint side = source->samples;
    const float step = 1.0f / (float)side;
    real sum = (real)(0.0f);
    for (uint j = 0; j < side; j++)
        for (uint i = 0; i < side; i++) {
            const real2 uv = make2(((float)i + offset.x) * step, ((float)j + offset.y) * step);
            const SourceSample s = source_sample(source, uv, v.surface.position);
            sum += sample_light(view, w, v, s, lanes, rays);
        }
    return scale3(uniform3(source->strength), sum / (float)(side * side));
}

INLINE real3 ambient_light(WhittedView w, TreeVertex v, real3 color) {
    return scale3(mul3(color, uniform3(w.settings->ambient)), PHONG(w, v, ambient));
}

// Emission and direct light; `rays` counts the shadow rays of each lane.
INLINE real3 surface_light(SceneView view, WhittedView w, TreeVertex v, natural sample, mask lanes,
                           natural* rays) {
    const real3 color = phong_color(view, w, v);
    const real2 offset = sample_offset(sample);
    real3 direct = ambient_light(w, v, color);
    for (uint i = 0; i < w.settings->source_count; i++) {
        const real3 light = source_light(view, w, v, w.sources + i, offset, lanes, rays);
        direct = add_light(w, direct, mul3(color, light));
    }
    const mask emits = lanes & material_emits(view, v.surface.material, v.surface.front);
    const real3 emission = material_emission(view, v.surface.material, v.surface.uv);
    return add_light(w, choose(emits, emission, zero3()), direct);
}

INLINE real3 tree_background(SceneView view, WhittedView w, real3 direction) {
    if (w.settings->has_background) return uniform3(w.settings->background);
    return environment_radiance(view, direction);
}

// The colour of the node itself, without its children.
OUTLINED real3 tree_color(SceneView view, WhittedView w, TreeVertex v, natural sample, mask lanes,
                          natural* rays) {
    real3 color = zero3();
    const mask missed = lanes & v.alive & !v.found, lit = lanes & v.alive & v.found;
    if_any (missed) color = choose(missed, tree_background(view, w, negate3(v.view)), color);
    if_any (lit) color = choose(lit, surface_light(view, w, v, sample, lit, rays), color);
    return color;
}

// A child of a node, where `exists`.
typedef struct {
    TreeRay ray;
    mask exists;
} TreeChild;

// Indices before over behind the surface.
INLINE real index_ratio(TreeVertex v, real ior) {
    return choose(v.surface.front, 1.0f / ior, ior);
}

INLINE TreeChild make_child(WhittedView w, TreeVertex v, real3 direction, real3 factor,
                            natural kind, mask exists) {
    TreeChild child;
    const AdvancedOrigin exit = tree_exit(v, direction);
    child.ray.origin = exit.origin;
    child.ray.passed = exit.passed;
    child.ray.direction = direction;
    child.ray.factor = factor;
    child.ray.product = v.product * max_component3(factor);
    child.ray.kind = kind;
    child.exists = exists & v.alive & v.found & (child.ray.product > w.settings->epsilon) &
                   (child.ray.product > 0.0f);
    return child;
}

// Fresnel's share of reflection, where the settings ask for it and light goes through; else 0.
INLINE real mirrored_share(WhittedView w, TreeVertex v) {
#if ONDE_TRANSLUCENT
    if (!w.settings->fresnel) return (real)(0.0f);
    const real cosine = clamp_real(dot3(v.surface.normal, v.view), 0.0f, 1.0f);
    return fresnel_dielectric(cosine, 1.0f / index_ratio(v, PHONG(w, v, ior)));
#else
    return (real)(0.0f);
#endif
}

INLINE TreeChild mirror_child(WhittedView w, TreeVertex v, natural kind) {
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
INLINE real3 transmitted_direction(TreeVertex v, real ratio) {
    const real3 n = v.surface.normal;
    const real cosine = dot3(n, v.view);
    const real sine2 = ratio * ratio * (1.0f - cosine * cosine);
    const real3 refracted =
        madd3(n, fma(ratio, cosine, -safe_sqrt(1.0f - sine2)), scale3(v.view, -ratio));
    return choose(sine2 > 1.0f, mirror_direction(v), normalize3(refracted));
}

// The transmitted child; `split` counts the wavelengths of a white ray, from 0.
INLINE TreeChild transmitted_child(WhittedView w, TreeVertex v, natural kind, uint split) {
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
INLINE TreeChild tree_child(WhittedView w, TreeVertex v, natural kind, uint i) {
#if ONDE_TRANSLUCENT
    if (i > 0) return transmitted_child(w, v, kind, i - 1);
#endif
    return mirror_child(w, v, kind);
}

#endif
