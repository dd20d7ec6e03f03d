// What is left of light after the surfaces between a point and a source: nothing behind an opaque
// one; translucent ones dim it and do not bend it.
#ifndef ONDE_CHAPTER_WHITTED_SHADOW_H
#define ONDE_CHAPTER_WHITTED_SHADOW_H

#include "shade/passing.h"
#include "shared/whitted.h"

#if ONDE_ALPHA
// How much of a hit's surface is there.
INLINE float scalar_opacity(SceneView view, Hit hit, float3 direction) {
    Hits hits;
    hits.t = (real)(hit.t);
    hits.u = (real)(hit.u);
    hits.v = (real)(hit.v);
    hits.primitive = (natural)(hit.primitive);
    hits.instance = (natural)(hit.instance);
    const real3 seen = make3((real)(direction.x), (real)(direction.y), (real)(direction.z));
    const mask all = hits.t == hits.t;
    float opacity[ONDE_WIDTH];
    spill_real(opacity, hit_opacity(view, hits, seen, all & !all, all));
    return opacity[0];
}
#endif

// A ray goes on behind what it has passed by this share of the largest number that went into it.
#define PASSED_SHARE 2e-5f

// The product of the transmissions along one ray.
OUTLINED float source_transmittance(SceneView view, __global const PhongRecord* phong,
                                    float3 origin, float3 direction, float distance) {
    const float3 a = fabs(origin);
    const float largest = max_fast(a.x, max_fast(a.y, a.z));
    float transmittance = 1.0f;
    float passed = 0.0f;
    for (;;) {
        const Hit hit = bvh_closest(view.bvh, origin, passed, direction, distance);
        if (hit.primitive == BVH_NONE) return transmittance;
        const uint material = SURFACE_MATERIAL(view.surfaces[hit.primitive].any.tag);
        float through = phong[material].transmission;
#if ONDE_ALPHA
        through = 1.0f - scalar_opacity(view, hit, direction) * (1.0f - through);
#endif
        transmittance *= through;
        if (!(transmittance > 0.0f)) return 0.0f;
        passed = hit.t + PASSED_SHARE * max_fast(largest, hit.t);
        if (!(passed < distance)) return transmittance;
    }
}

#endif
