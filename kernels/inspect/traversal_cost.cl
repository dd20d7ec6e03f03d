// What the camera ray of each pixel's first sample costs: boxes and primitives tested. Compile with
// ONDE_TRAVERSAL_COST=1 and ONDE_WIDTH=1.
#include "shade/camera.h"
#include "shade/scene_view.h"
#include "trace/bvh.h"

__kernel void pixel_cost(uint count, SCENE_PARAMETERS, __global uint* tests) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    SCENE_VIEW(view);
#if ONDE_TRAVERSAL_COST
    const uint pixel = i % frame->width | i / frame->width << 16;
    const CameraRay ray = camera_ray(frame, pixel, sampler_start(pixel, 0, frame->seed));
    const Hit hit = bvh_closest(view.bvh, (float3)(ray.origin.x, ray.origin.y, ray.origin.z), 0.0f,
                                (float3)(ray.direction.x, ray.direction.y, ray.direction.z),
                                INFINITY TIME(0.0f));
    tests[2 * i] = hit.boxes;
    tests[2 * i + 1] = hit.primitives;
#endif
}
