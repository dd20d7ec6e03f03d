// Surfaces that rays pass: where their alpha leaves room, and backs that only light meets.
// Traversals know nothing of it: a ray that passes what it has hit goes on behind it.
//
// Backs are culled for rays that show the scene: the camera's, and those that mirrors and clear
// glass send on. Light does not care for the side of a surface: it would leak into closed rooms.
#ifndef ONDE_SHADE_PASSING_H
#define ONDE_SHADE_PASSING_H

#include "shade/straight.h"
#include "trace/trace.h"

INLINE mask is_double_sided(SceneView view, natural material) {
    return RECORD_NATURAL(view.materials, material, MaterialRecord, double_sided) != 0u;
}

#if ONDE_PASSING

INLINE mask is_triangle(natural tag) {
    return (tag & (SURFACE_SPHERE | SURFACE_SHAPE)) == 0u;
}

    // The most surfaces that a ray passes. Behind them a path ends as if the next were opaque, and
    // no light arrives.
    #define MOST_PASSED 256u

    #if ONDE_CULLING
// Which hits of `lanes` are backs that are not seen, by rays of direction `seen` on `material`.
INLINE mask is_culled(SceneView view, Hits hits, real3 seen, natural record, natural material,
                      mask lanes) {
    mask culled = lanes & !is_double_sided(view, material);
    if_any (culled) {
        const natural instance = choose(culled, hits.instance, (natural)(BVH_NONE));
        const real3 normal =
            placed_normal(placement_of(view, instance),
                          RECORD3(view.surfaces, record, SurfaceRecord, triangle.geometric));
        culled = culled & !(dot3(normal, seen) < 0.0f);
    }
    return culled;
}
    #endif

// Which hits of `lanes` may be passed at all, by rays of direction `seen`; `culls`: as in
// hit_opacity. That of backs is known here, as most surfaces show their fronts.
INLINE mask may_pass(SceneView view, Hits hits, real3 seen, mask culls, mask lanes) {
    const natural record = choose(lanes, hits.primitive, (natural)(0u));
    const natural tag = SURFACE_NATURAL(view, record, any.tag);
    const natural material = SURFACE_MATERIAL(tag);
    mask may = lanes & !lanes;
    #if ONDE_CULLING
    culls = culls & lanes & is_triangle(tag);
    if_any (culls) may = is_culled(view, hits, seen, record, material, culls);
    #endif
    #if ONDE_ALPHA
    const natural mode = RECORD_NATURAL(view.materials, material, MaterialRecord, alpha_mode);
    may = may | (lanes & (mode != ALPHA_OPAQUE));
    #endif
    return may;
}

// The opacity of what the rays of `lanes` have hit. `seen` is the direction of sight, in which the
// backs of triangles are culled for the lanes in `culls`.
OUTLINED real hit_opacity(SceneView view, Hits hits, real3 seen, mask culls, mask lanes) {
    const natural record = choose(lanes, hits.primitive, (natural)(0u));
    const natural tag = SURFACE_NATURAL(view, record, any.tag);
    const natural material = SURFACE_MATERIAL(tag);
    const mask triangle = lanes & is_triangle(tag);
    real opacity = (real)(1.0f);
    #if ONDE_ALPHA
    const real u = choose(triangle, hits.u, (real)(0.0f));
    const real v = choose(triangle, hits.v, (real)(0.0f));
    const Corners corners = triangle_corners(view, record, triangle);
    opacity = material_opacity(view, material, triangle_uv(view, corners, u, v),
                               triangle_alpha(view, corners, u, v));
    #endif
    #if ONDE_CULLING
    const mask culled = is_culled(view, hits, seen, record, material, triangle & culls);
    opacity = choose(culled, (real)(0.0f), opacity);
    #endif
    return opacity;
}

// Where the rays of `lanes` end, whose closest hits are given. u, in [0, 1), decides how many
// blended surfaces a ray passes: each takes its share of what the ones before have left.
OUTLINED Hits pass_surfaces(SceneView view, real3 origin, real3 direction, Hits hits, real u,
                            mask culls, mask lanes) {
    mask open = lanes & (hits.primitive != BVH_NONE);
    for (uint passed = 0; passed < MOST_PASSED && mask_bits(open); passed++) {
        const real opacity = hit_opacity(view, hits, direction, culls, open);
        const mask passes = open & !(u < opacity);
        const uint bits = mask_bits(passes);
        if (!bits) break;
        const real left = (u - opacity) / max_real(1.0f - opacity, (real)(1e-9f));
        u = choose(passes, clamp_real(left, 0.0f, 0.99999994f), u);
        hits = trace_behind(view.bvh, origin, direction, (real)(RAY_INFINITY), hits, bits);
        open = passes & (hits.primitive != BVH_NONE);
    }
    return hits;
}

// How much of the light comes through from the origins to `distance`, for connections in `lanes`;
// nothing in the others. seen, culls: as in hit_opacity. way: as of Connection. key: of random
// numbers, which only grids of media ask for.
OUTLINED real3 ray_transmittance(SceneView view, real3 origin, real3 direction, real distance,
                                 real3 seen, mask culls, natural way, natural key, mask lanes) {
    Hits hits;
    hits.t = hits.u = hits.v = (real)(0.0f);
    hits.primitive = hits.instance = (natural)(0u);
    real3 through = choose(lanes, splat3((real)(1.0f)), zero3());
    mask open = lanes;
    for (uint passed = 0; passed < MOST_PASSED; passed++) {
        const real before = hits.t;
        hits = trace_behind(view.bvh, origin, direction, distance, hits, mask_bits(open));
    #if ONDE_MEDIA
        const real to = choose(hits.primitive != BVH_NONE, hits.t, distance);
        const real3 inside = medium_transmittance(view, medium_within(way), origin, direction,
                                                  before, to, key + passed, open);
        through = choose(open, mul3(through, inside), through);
    #endif
        open = open & (hits.primitive != BVH_NONE);
        if (!mask_bits(open)) return through;
        const real opacity = hit_opacity(view, hits, seen, culls, open);
        real3 left = splat3(1.0f - opacity);
    #if ONDE_STRAIGHT
        const Surface s = surface_at(view, origin, direction, hits, open);
        const mask unbent = (way & WAY_UNBENT) != 0u;
        left = madd3(straight_transmittance(view, s, direction, hits.t - before, unbent, open),
                     opacity, left);
    #endif
    #if ONDE_MEDIA
        const natural beyond = media_beyond(view, way & ~WAY_UNBENT, s.material, s.front);
        way = choose(open, (way & WAY_UNBENT) | beyond, way);
    #endif
        through = choose(open, mul3(through, left), through);
        open = open & nonzero3(through);
        if (!mask_bits(open)) return through;
    }
    return choose(open, zero3(), through);
}

#endif

#endif
