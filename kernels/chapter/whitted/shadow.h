// What is left of light after the surfaces between a point and a source: nothing behind an opaque
// one; translucent ones dim it and do not bend it.
#ifndef ONDE_CHAPTER_WHITTED_SHADOW_H
#define ONDE_CHAPTER_WHITTED_SHADOW_H

#include "shade/surface.h"
#include "shared/whitted.h"
#include "trace/bvh.h"

// The product of the transmissions along one ray.
OUTLINED float ray_transmittance(SceneView view, __global const PhongRecord* phong, float3 origin,
                                 float3 direction, float distance) {
    const float3 a = fabs(origin);
    const float largest = max_fast(a.x, max_fast(a.y, a.z));
    float transmittance = 1.0f;
    float passed = 0.0f;
    for (;;) {
        const Hit hit = bvh_closest(view.bvh, origin, passed, direction, distance);
        if (hit.primitive == BVH_NONE) return transmittance;
        const uint material = SURFACE_MATERIAL(view.surfaces[hit.primitive].any.tag);
        transmittance *= phong[material].transmission;
        if (!(transmittance > 0.0f)) return 0.0f;
        passed = hit.t + ORIGIN_OFFSET * max_fast(largest, hit.t);
        if (!(passed < distance)) return transmittance;
    }
}

#endif
