// Cameras that see more than a plane shows: from a place on the film to a direction, and back.
#ifndef ONDE_SHADE_PROJECTION_H
#define ONDE_SHADE_PROJECTION_H

#include "math/elementary.h"
#include "shared/frame.h"

// Whether some camera is one.
#ifndef ONDE_PROJECTIONS
    #define ONDE_PROJECTIONS 0
#endif

#if ONDE_PROJECTIONS

INLINE bool is_wide(__global const FrameRecord* frame) {
    return frame->projection != PROJECTION_RECTILINEAR;
}
INLINE bool is_panorama(__global const FrameRecord* frame) {
    return frame->projection == PROJECTION_PANORAMA;
}

// A direction, by the camera's axes: to the right, up and ahead.
INLINE real3 by_axes(__global const FrameRecord* frame, real3 d) {
    return make3(dot3(d, uniform3(frame->lens_u)), dot3(d, uniform3(frame->lens_v)),
                 dot3(d, uniform3(frame->forward)));
}
INLINE real3 from_axes(__global const FrameRecord* frame, real3 d) {
    return madd3(uniform3(frame->lens_u), d.x,
                 madd3(uniform3(frame->lens_v), d.y, scale3(uniform3(frame->forward), d.z)));
}

// The radius of a fisheye's circle, in pixels.
INLINE float fisheye_radius(__global const FrameRecord* frame) {
    return 0.5f * (float)(min(frame->width, frame->height));
}

// Unit, of a place in pixels, y downward. A panorama's goes on beyond its edges, over the poles.
INLINE real3 wide_direction(__global const FrameRecord* frame, real x, real y) {
    const float width = (float)(frame->width), height = (float)(frame->height);
    if (is_panorama(frame)) {
        const SineCosine along = sincos_turns(x / width - 0.5f);
        const SineCosine up = sincos_turns(0.25f - 0.5f * (y / height));
        return from_axes(frame, make3(along.sine * up.cosine, up.sine, along.cosine * up.cosine));
    }
    const real right = x - 0.5f * width, above = 0.5f * height - y;
    const real radius = sqrt(fma(right, right, above * above));
    const SineCosine off = sincos_turns(radius * frame->fisheye_step);
    const real ring = choose(radius > 0.0f, off.sine / radius, (real)(0.0f));
    return normalize3(from_axes(frame, make3(right * ring, above * ring, off.cosine)));
}

// Whether a place of the film shows something: outside of a fisheye's circle is nothing.
INLINE mask wide_shows(__global const FrameRecord* frame, real x, real y) {
    if (is_panorama(frame)) return x == x;
    const real right = x - 0.5f * (float)(frame->width), above = y - 0.5f * (float)(frame->height);
    const float radius = fisheye_radius(frame);
    return fma(right, right, above * above) <= radius * radius;
}

// Where a direction is seen, and how many pixels a steradian has there.
typedef struct {
    real x, y;
    real density;
} WidePlace;

// Of a direction of any length but 0.
INLINE WidePlace wide_place(__global const FrameRecord* frame, real3 direction) {
    const float width = (float)(frame->width), height = (float)(frame->height);
    const real3 d = by_axes(frame, direction);
    const real level2 = fma(d.x, d.x, d.z * d.z), side2 = fma(d.x, d.x, d.y * d.y);
    const real length = sqrt(fma(d.y, d.y, level2));
    WidePlace place;
    if (is_panorama(frame)) {
        const real level = sqrt(level2);
        const real along = angle_turns(d.x, d.z);
        place.x = width * (along + choose(along > 0.5f, (real)(-0.5f), (real)(0.5f)));
        place.y = height * 2.0f * angle_turns(level, d.y);
        const real cosine = max_real(level / length, (real)(1e-7f));
        place.density = width * height * (0.5f * INV_PI * INV_PI) / cosine;
        return place;
    }
    const real side = sqrt(side2), per_turn = (real)(1.0f / frame->fisheye_step);
    const real radius = angle_turns(side, d.z) * per_turn;
    const real on_axis = per_turn * (0.5f * INV_PI); // pixels a radian
    const mask off = side > 1e-6f * length;
    const real per_side = choose(off, radius / side, on_axis / length);
    place.x = fma(d.x, per_side, (real)(0.5f * width));
    place.y = fma(d.y, -per_side, (real)(0.5f * height));
    place.density = choose(off, per_side * length, on_axis) * on_axis;
    return place;
}

#endif

#endif
