// Light sources as the chapter has them: which point of one a sample looks at.
#ifndef ONDE_CHAPTER_WHITTED_SOURCE_H
#define ONDE_CHAPTER_WHITTED_SOURCE_H

#include "math/elementary.h"
#include "shared/whitted.h"

#define SOURCE_INFINITY 1e30f

// The segment from a point to a sample of a source.
typedef struct {
    real3 direction; // unit
    real3 target;    // where the segment ends; unused when it does not
    real distance;   // SOURCE_INFINITY for directional sources
    mask lit;        // whether the source shines this way
} SourceSample;

// Offsets in [0, 1) by sample index: the R2 sequence, exact.
INLINE real2 sample_offset(natural sample) {
    const natural x = 0x80000000u + sample * 0xC13FA9A9u, y = 0x80000000u + sample * 0x91E10DA6u;
    return make2(to_real(x >> 8) * (1.0f / 16777216.0f), to_real(y >> 8) * (1.0f / 16777216.0f));
}

// A point of the unit disk by two coordinates in [0, 1).
INLINE real2 polar_disk(real2 uv) {
    const real radius = sqrt(uv.x);
    const SineCosine angle = sincos_turns(uv.y);
    return make2(radius * angle.cosine, radius * angle.sine);
}

INLINE real3 on_edges(__global const SourceRecord* source, real2 at) {
    return madd3(uniform3(source->edge2), at.y,
                 madd3(uniform3(source->edge1), at.x, uniform3(source->position)));
}

// On the disk of the sphere that faces `from`.
INLINE real3 on_facing_disk(__global const SourceRecord* source, real2 at, real3 from) {
    const real3 center = uniform3(source->position);
    const real3 w = normalize3(sub3(from, center));
    const real zero = (real)(0.0f), one = (real)(1.0f);
    const real3 helper = choose(fabs(w.x) > 0.9f, make3(zero, one, zero), make3(one, zero, zero));
    const real3 t = normalize3(cross3(w, helper)), b = cross3(w, t);
    const real radius = (real)(source->radius);
    return madd3(b, at.y * radius, madd3(t, at.x * radius, center));
}

// Where the segment from `from` toward a point inside the sphere meets it first.
INLINE real sphere_entry(__global const SourceRecord* source, real3 from, real3 direction) {
    const real3 to = sub3(uniform3(source->position), from);
    const real along = dot3(to, direction);
    const real3 across = madd3(direction, -along, to);
    return along - safe_sqrt(source->radius * source->radius - dot3(across, across));
}

// uv: in the unit square, over the source.
INLINE SourceSample source_sample(__global const SourceRecord* source, real2 uv, real3 from) {
    SourceSample s;
    s.lit = (mask)(from.x == from.x);
    if (source->kind == SOURCE_DIRECTIONAL) {
        s.direction = uniform3(source->position);
        s.target = s.direction;
        s.distance = (real)(SOURCE_INFINITY);
        return s;
    }
    real3 point = uniform3(source->position);
    if (source->kind == SOURCE_RECTANGLE) point = on_edges(source, uv);
    if (source->kind == SOURCE_DISK) point = on_edges(source, polar_disk(uv));
    if (source->kind == SOURCE_SPHERE) point = on_facing_disk(source, polar_disk(uv), from);
    const real3 to = sub3(point, from);
    s.distance = length3(to);
    s.direction = scale3(to, 1.0f / s.distance);
    s.lit = s.distance > 0.0f;
    if (source->kind == SOURCE_SPHERE) {
        const real entry = sphere_entry(source, from, s.direction);
        s.lit = s.lit & (entry > 0.0f);
        s.distance = choose(s.lit, entry, s.distance);
    } else if (source->kind != SOURCE_POINT && !source->two_sided) {
        const real3 front = cross3(uniform3(source->edge1), uniform3(source->edge2));
        s.lit = s.lit & (dot3(front, s.direction) < 0.0f);
    }
    s.target = madd3(s.direction, s.distance, from);
    return s;
}

#endif
