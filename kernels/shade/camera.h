// From a pixel and a sample to a ray: pinhole, thin lens, orthographic or wide, with an
// importance-sampled filter.
#ifndef ONDE_SHADE_CAMERA_H
#define ONDE_SHADE_CAMERA_H

#include "math/random.h"
#include "math/sampling.h"
#include "shade/projection.h"
#include "shared/frame.h"

typedef struct {
    real3 origin, direction; // direction is unit
#if ONDE_PROJECTIONS
    mask shows; // else nothing is seen there
#endif
} CameraRay;

// Offset from the pixel's centre, in pixels, distributed as the filter.
INLINE real filter_offset(__global const FrameRecord* frame, real u) {
    const real x = u * (float)(FILTER_TABLE_SIZE - 1);
    const real below = floor(x);
    const natural i = as_natural(to_integer(below));
    const real low = gather_real(frame->filter_table, i);
    const real high = gather_real(frame->filter_table, i + 1u);
    return fma(x - below, high - low, low);
}

// A point of the focus plane, or of the screen, by film coordinates in pixels, y downward.
INLINE real3 camera_target(__global const FrameRecord* frame, real x, real y) {
    return madd3(uniform3(frame->step_y), y,
                 madd3(uniform3(frame->step_x), x, uniform3(frame->corner)));
}

// How far from the view axis the middle of the lens sees what lies in direction `to`, of any
// length, or of parallel rays what lies by that from the middle of the screen: in pixels, y
// downward.
INLINE real2 film_place(__global const FrameRecord* frame, real3 to) {
#if ONDE_PROJECTIONS
    if (is_wide(frame)) {
        const WidePlace place = wide_place(frame, to);
        return make2(place.x, place.y);
    }
#endif
    const real3 step_x = uniform3(frame->step_x), step_y = uniform3(frame->step_y);
    real scale = 1.0f / dot3(step_x, step_x);
    if (!frame->orthographic) scale *= frame->focus_distance / dot3(to, uniform3(frame->forward));
    return make2(dot3(to, step_x) * scale, dot3(to, step_y) * scale);
}

// A point of a lens of radius 1: of its disk, or of the polygon that its blades leave open.
INLINE real2 lens_place(__global const FrameRecord* frame, real2 u) {
    const uint blades = frame->aperture_blades;
    if (blades == 0) return sample_disk(u);
    const real which = u.x * (float)(blades);
    const real corner = min_real(floor(which), (real)((float)(blades)-1.0f));
    const real out = safe_sqrt(which - corner);
    const real share = (real)(1.0f / (float)(blades));
    const real turn = fma(corner, share, (real)(frame->aperture_turn));
    const SineCosine from = sincos_turns(turn - floor(turn));
    const SineCosine to = sincos_turns(turn + share - floor(turn + share));
    return make2(out * fma(to.cosine - from.cosine, u.y, from.cosine),
                 out * fma(to.sine - from.sine, u.y, from.sine));
}

#if ONDE_PROJECTIONS
    // Beyond everything: a ray that starts there, and leads on, meets nothing.
    #define FAR_OUT 1e15f

INLINE CameraRay wide_ray(__global const FrameRecord* frame, real x, real y) {
    CameraRay ray;
    ray.shows = wide_shows(frame, x, y);
    ray.direction = wide_direction(frame, x, y);
    const real3 origin = uniform3(frame->origin);
    ray.origin = choose(ray.shows, origin, madd3(ray.direction, FAR_OUT, origin));
    return ray;
}
#endif

// The ray through film coordinates, without a lens.
INLINE CameraRay camera_ray_through(__global const FrameRecord* frame, real x, real y) {
#if ONDE_PROJECTIONS
    if (is_wide(frame)) return wide_ray(frame, x, y);
#endif
    const real3 target = camera_target(frame, x, y);
    CameraRay ray;
    ray.origin = frame->orthographic ? target : uniform3(frame->origin);
    ray.direction =
        frame->orthographic ? uniform3(frame->forward) : normalize3(sub3(target, ray.origin));
#if ONDE_PROJECTIONS
    ray.shows = x == x;
#endif
    return ray;
}

// pixel: x | y << 16, y downward.
INLINE CameraRay camera_ray(__global const FrameRecord* frame, natural pixel, Sampler sampler) {
    const real2 u = sampler_pair(sampler, DIMENSION_FILTER);
    const real x = to_real(pixel & 0xffffu) + 0.5f + filter_offset(frame, u.x);
    const real y = to_real(pixel >> 16) + 0.5f + filter_offset(frame, u.y);
    CameraRay ray = camera_ray_through(frame, x, y);
    if (frame->orthographic || frame->aperture_radius <= 0.0f) return ray;
    const real2 lens = lens_place(frame, sampler_pair(sampler, DIMENSION_LENS));
    ray.origin = madd3(uniform3(frame->lens_u), lens.x * frame->aperture_radius, ray.origin);
    ray.origin = madd3(uniform3(frame->lens_v), lens.y * frame->aperture_radius, ray.origin);
    ray.direction = normalize3(sub3(camera_target(frame, x, y), ray.origin));
    return ray;
}

#endif
