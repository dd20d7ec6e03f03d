// What is left of light after the surfaces between a point and a source: nothing behind an opaque
// one; translucent ones dim it and do not bend it.
#ifndef ONDE_CHAPTER_WHITTED_SHADOW_H
#define ONDE_CHAPTER_WHITTED_SHADOW_H

#include "shade/scene_view.h"
#include "shade/surface.h"
#include "shared/whitted.h"
#include "trace/trace.h"

// Whether some material lets light through; the host compiles only what the scene needs.
#ifndef ONDE_TRANSLUCENT
    #define ONDE_TRANSLUCENT 1
#endif

#if ONDE_TRANSLUCENT
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
        const uint material = view.surfaces[hit.primitive].material & SURFACE_MATERIAL_MASK;
        transmittance *= phong[material].transmission;
        if (!(transmittance > 0.0f)) return 0.0f;
        passed = hit.t + ORIGIN_OFFSET * max_fast(largest, hit.t);
        if (!(passed < distance)) return transmittance;
    }
}
#endif

// The same for the lanes in `bits`; 0 for the others.
INLINE real transmittance(SceneView view, __global const PhongRecord* phong, real3 origin,
                          real3 direction, real distance, uint bits) {
    const uint blocked = trace_occluded(view.bvh, origin, direction, distance, bits);
    real result = choose(mask_from_bits(bits & ~blocked), (real)(1.0f), (real)(0.0f));
#if ONDE_TRANSLUCENT
    if (blocked) {
        SpilledRays rays;
        spill_rays(&rays, origin, direction);
        float far[ONDE_WIDTH], left[ONDE_WIDTH];
        spill_real(far, distance);
        spill_real(left, result);
        for (uint rest = blocked; rest; rest &= rest - 1) {
            const uint k = lowest_bit(rest);
            left[k] = ray_transmittance(view, phong, spilled_origin(&rays, k),
                                        spilled_direction(&rays, k), far[k]);
        }
        result = unspill_real(left);
    }
#endif
    return result;
}

#endif
