// Rays against the chapter's bounding volumes (C12). Conservative: a ray that meets the volume in
// exact arithmetic, from its origin on, is never rejected; one that passes by within the rounding
// of floats may be let through. Directions have any length within 1e-9 to 1e9.
#ifndef ONDE_CHAPTER_VOLUMES_H
#define ONDE_CHAPTER_VOLUMES_H

#include "math/vector.h"
#include "shared/volumes.h"

// Slabs are widened by this part of what goes into a distance along their normal: |origin| + reach,
// in the norm of sums. Rounding two dot products, a difference and a quotient takes less than
// eight half units in the last place, 4.8e-7; when the computed direction along the normal is off
// by rounding, so is the place of a hit, by no more than that part of its way.
#define VOLUME_SLACK 6e-7f

// The part of a ray that lies inside.
typedef struct {
    real near, far;
} Span;

INLINE Span whole_ray(void) {
    Span span;
    span.near = (real)(0.0f);
    span.far = (real)(INFINITY);
    return span;
}
INLINE mask is_met(Span span) {
    return span.near <= span.far;
}
INLINE real sum_of_magnitudes3(real3 v) {
    return fabs(v.x) + fabs(v.y) + fabs(v.z);
}

// What is left of the span between two parallel planes. `start` and `speed` are the ray's origin
// and direction along their normal.
INLINE Span cut_span(Span span, real start, real speed, real low, real high) {
    // A finite stand-in for infinity keeps 0 * infinity out of it.
    const real safe = choose(fabs(speed) < 1e-18f, copysign((real)(1e-18f), speed), speed);
    const real inverse = 1.0f / safe;
    const real a = (low - start) * inverse, b = (high - start) * inverse;
    span.near = max_real(span.near, min_real(a, b));
    span.far = min_real(span.far, max_real(a, b));
    return span;
}

INLINE mask box_met(BoxVolume box, real3 origin, real3 direction) {
    const real margin = VOLUME_SLACK * (sum_of_magnitudes3(origin) + box.reach);
    Span span = whole_ray();
    span = cut_span(span, origin.x, direction.x, box.low[0] - margin, box.high[0] + margin);
    span = cut_span(span, origin.y, direction.y, box.low[1] - margin, box.high[1] + margin);
    span = cut_span(span, origin.z, direction.z, box.low[2] - margin, box.high[2] + margin);
    return is_met(span);
}

INLINE real along3(const float* axis, real3 v) {
    return fma((real)(axis[2]), v.z, fma((real)(axis[1]), v.y, axis[0] * v.x));
}

INLINE mask oriented_box_met(OrientedBoxVolume box, real3 origin, real3 direction) {
    const real margin = VOLUME_SLACK * (sum_of_magnitudes3(origin) + box.reach);
    Span span = whole_ray();
    for (int k = 0; k < 3; k++) {
        const float* axis = box.axes + 3 * k;
        span = cut_span(span, along3(axis, origin), along3(axis, direction), box.low[k] - margin,
                        box.high[k] + margin);
    }
    return is_met(span);
}

// A vector along the normals of the slabs, in the order of SlabsVolume.
typedef struct {
    real a[MANY_SLABS];
} AlongSlabs;

INLINE AlongSlabs along_slabs(real3 v) {
    AlongSlabs s;
    s.a[0] = v.x;
    s.a[1] = v.y;
    s.a[2] = v.z;
    s.a[7] = v.x + v.y;
    s.a[8] = v.x - v.y;
    s.a[9] = v.x + v.z;
    s.a[10] = v.x - v.z;
    s.a[11] = v.y + v.z;
    s.a[12] = v.y - v.z;
    s.a[3] = s.a[7] + v.z;
    s.a[4] = s.a[7] - v.z;
    s.a[5] = s.a[8] + v.z;
    s.a[6] = v.z - s.a[8];
    return s;
}

// `count` is FEW_SLABS or MANY_SLABS.
INLINE mask slabs_met(SlabsVolume slabs, uint count, real3 origin, real3 direction) {
    const real margin = VOLUME_SLACK * (sum_of_magnitudes3(origin) + slabs.reach);
    const AlongSlabs start = along_slabs(origin), speed = along_slabs(direction);
    Span span = whole_ray();
    for (uint k = 0; k < count; k++)
        span =
            cut_span(span, start.a[k], speed.a[k], slabs.low[k] - margin, slabs.high[k] + margin);
    return is_met(span);
}

// By the distance of the line from the centre, without cancellation (Haines et al., "Precision
// improvements for ray/sphere intersection", Ray Tracing Gems, 2019, chapter 7).
INLINE mask sphere_met(SphereVolume sphere, real3 origin, real3 direction) {
    const real3 from_center = make3(origin.x - sphere.center[0], origin.y - sphere.center[1],
                                    origin.z - sphere.center[2]);
    const real behind = dot3(from_center, direction);
    const real3 foot = madd3(direction, -behind / dot3(direction, direction), from_center);
    const real radius = sphere.radius + 1e-6f * (sum_of_magnitudes3(from_center) + sphere.radius);
    const real radius2 = radius * radius;
    const mask ahead = (behind <= 0.0f) | (dot3(from_center, from_center) <= radius2);
    return ahead & (dot3(foot, foot) <= radius2);
}

#endif
