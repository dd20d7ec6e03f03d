// A ray against the analytic shapes in their own spaces (see onde::Shape): ellipsoid, disk,
// cylinder, cone, torus. Scalar, as all of traversal. Distances count from the point of the ray
// that is nearest the shape's centre, so that a far origin costs no digits there.
#ifndef ONDE_TRACE_SHAPE_H
#define ONDE_TRACE_SHAPE_H

#include "trace/bvh_bits.h"

// A ray with unit direction and an origin that is perpendicular to it; `start` is where the given
// origin lies, `scale` the length of the given direction.
typedef struct {
    float3 origin, direction;
    float start, scale;
} CentredRay;

INLINE float dot_scalar(float3 a, float3 b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}

INLINE float square_scalar(float a) {
    return a * a;
}

INLINE CentredRay centre_ray(float3 origin, float3 direction) {
    CentredRay ray;
    ray.scale = sqrt(dot_scalar(direction, direction));
    ray.direction = direction * (1.0f / ray.scale);
    ray.start = dot_scalar(origin, ray.direction);
    ray.origin = fma((float3)(-ray.start), ray.direction, origin);
    return ray;
}

// The part of a ray inside a convex shape; nothing where x <= y does not hold.
#define OUTSIDE ((float2)(INFINITY, -INFINITY))
INLINE float2 common_part(float2 a, float2 b) {
    return (float2)(max_fast(a.x, b.x), min_fast(a.y, b.y));
}

// Where a t^2 + 2 b t + c <= 0 for a > 0, without cancellation.
INLINE float2 between_roots(float a, float b, float c) {
    const float discriminant = fma(b, b, -(a * c));
    if (!(discriminant >= 0.0f)) return OUTSIDE;
    const float q = -(b + copysign(sqrt(discriminant), b));
    if (q == 0.0f) return (float2)(0.0f, 0.0f);
    return (float2)(min_fast(q / a, c / q), max_fast(q / a, c / q));
}

// Where low <= y <= high.
INLINE float2 between_planes(CentredRay ray, float low, float high) {
    if (ray.direction.y == 0.0f)
        return ray.origin.y >= low && ray.origin.y <= high ? (float2)(-INFINITY, INFINITY)
                                                           : OUTSIDE;
    const float a = (low - ray.origin.y) / ray.direction.y;
    const float b = (high - ray.origin.y) / ray.direction.y;
    return (float2)(min_fast(a, b), max_fast(a, b));
}

INLINE float2 in_unit_sphere(CentredRay ray) {
    const float half2 = 1.0f - dot_scalar(ray.origin, ray.origin);
    if (!(half2 >= 0.0f)) return OUTSIDE;
    return (float2)(-sqrt(half2), sqrt(half2));
}

INLINE float2 in_disk(CentredRay ray) {
    if (ray.direction.y == 0.0f) return OUTSIDE;
    const float t = -ray.origin.y / ray.direction.y;
    const float x = fma(t, ray.direction.x, ray.origin.x);
    const float z = fma(t, ray.direction.z, ray.origin.z);
    return fma(x, x, z * z) <= 1.0f ? (float2)(t, t) : OUTSIDE;
}

INLINE float2 in_cylinder(CentredRay ray) {
    const float3 o = ray.origin, d = ray.direction;
    const float2 slab = between_planes(ray, -1.0f, 1.0f);
    const float a = fma(d.x, d.x, d.z * d.z), c = fma(o.x, o.x, o.z * o.z) - 1.0f;
    if (a < 1e-14f) return c <= 0.0f ? slab : OUTSIDE; // along the axis
    return common_part(slab, between_roots(a, fma(o.x, d.x, o.z * d.z), c));
}

// Of the two nappes of x^2 + z^2 = (1 - y)^2 the lower one, above its base.
INLINE float2 in_cone(CentredRay ray) {
    const float3 o = ray.origin, d = ray.direction;
    const float below = 1.0f - o.y; // grows by -d.y along the ray
    const float a = fma(d.x, d.x, fma(d.z, d.z, -(d.y * d.y)));
    const float b = fma(o.x, d.x, fma(o.z, d.z, below * d.y));
    const float c = fma(o.x, o.x, fma(o.z, o.z, -(below * below)));
    const float2 slab = between_planes(ray, 0.0f, 1.0f);
    if (a > 0.0f) { // flatter than the side: both crossings are on the same nappe
        const float2 part = between_roots(a, b, c);
        const float middle = -b / a;
        return below - middle * d.y >= 0.0f ? common_part(slab, part) : OUTSIDE;
    }
    // Steeper: one crossing on each nappe, and the lower nappe beyond its own.
    const float q = -(b + copysign(sqrt(max_fast(fma(b, b, -(a * c)), 0.0f)), b));
    const float r0 = q / a, r1 = q == 0.0f ? 0.0f : c / q;
    const float first = a == 0.0f ? r1 : min_fast(r0, r1), last = a == 0.0f ? r1 : max_fast(r0, r1);
    const float2 lower_nappe = d.y < 0.0f ? (float2)(last, INFINITY) : (float2)(-INFINITY, first);
    return common_part(slab, lower_nappe);
}

// The torus of major radius 1 about the Y axis. With t measured from the point nearest its centre,
// (|p|^2 + 1 - r^2)^2 - 4 (x^2 + z^2) = t^4 + b t^2 + c t + e.
typedef struct {
    CentredRay ray;
    float minor2, b, c;
} TorusRay;

INLINE TorusRay make_torus_ray(CentredRay ray, float minor_radius) {
    TorusRay torus;
    torus.ray = ray;
    torus.minor2 = minor_radius * minor_radius;
    const float m = dot_scalar(ray.origin, ray.origin), dy = ray.direction.y;
    torus.b = 2.0f * (m + 1.0f - torus.minor2) - 4.0f * (1.0f - dy * dy);
    torus.c = 8.0f * ray.origin.y * dy;
    return torus;
}

// The quartic's value, from its two factors of which one is positive: no cancellation near the
// surface, where (sqrt(x^2 + z^2) - 1)^2 + y^2 = r^2.
INLINE float torus_value(TorusRay torus, float t) {
    const float3 p = fma((float3)(t), torus.ray.direction, torus.ray.origin);
    const float rho = sqrt(fma(p.x, p.x, p.z * p.z));
    const float y2 = p.y * p.y - torus.minor2;
    return fma(rho - 1.0f, rho - 1.0f, y2) * fma(rho + 1.0f, rho + 1.0f, y2);
}

// Its derivative over 4, and that one's derivative.
INLINE float torus_slope(TorusRay torus, float t) {
    return fma(fma(t, t, 0.5f * torus.b), t, 0.25f * torus.c);
}
INLINE float torus_bend(TorusRay torus, float t) {
    return fma(3.0f * t, t, 0.5f * torus.b);
}

// Newton's method, kept in a bracket [low, high] in which the function is monotone and changes
// sign; `sign` makes it grow. Enough steps that bisection alone would end with all bits of a float.
#define TORUS_STEPS 28
#define DEFINE_TORUS_ROOT(name, value, slope)                                                      \
    INLINE float name(TorusRay torus, float low, float high, float sign) {                         \
        float t = 0.5f * (low + high);                                                             \
        for (uint i = 0; i < TORUS_STEPS; i++) {                                                   \
            const float f = sign * value(torus, t);                                                \
            if (f < 0.0f)                                                                          \
                low = t;                                                                           \
            else                                                                                   \
                high = t;                                                                          \
            const float newton = t - f / (sign * slope(torus, t));                                 \
            const float next = newton > low && newton < high ? newton : 0.5f * (low + high);       \
            if (fabs(next - t) < 1e-7f) return next;                                               \
            t = next;                                                                              \
        }                                                                                          \
        return t;                                                                                  \
    }
INLINE float torus_slope4(TorusRay torus, float t) {
    return 4.0f * torus_slope(torus, t);
}
DEFINE_TORUS_ROOT(torus_turn, torus_slope, torus_bend)
DEFINE_TORUS_ROOT(torus_root, torus_value, torus_slope4)

// Adds to `at`, which ascends, the turn of the quartic in [low, high], if there is one.
INLINE uint add_turn(TorusRay torus, float low, float high, float* at, uint count) {
    const float from = torus_slope(torus, low), to = torus_slope(torus, high);
    if (!(low < high) || (from < 0.0f) == (to < 0.0f)) return count;
    at[count] = torus_turn(torus, low, high, from < 0.0f ? 1.0f : -1.0f);
    return count + 1;
}

// The nearest root beyond `near`, or infinity; any answer where it lies beyond `far`. Between its
// turns the quartic is monotone, so that a sign at each end decides whether there is a root: none
// is missed, none is found twice. `far` does not bound the search: what a traversal has hit before
// must not move a root by its last bits.
OUTLINED float torus_distance(TorusRay torus, float near, float far) {
    const float reach2 = square_scalar(1.0001f + sqrt(torus.minor2)) -
                         dot_scalar(torus.ray.origin, torus.ray.origin);
    if (!(reach2 > 0.0f)) return INFINITY;
    // Roots at the outer equator lie on this very ball: the search starts well clear of it.
    const float reach = sqrt(reach2) + 0.01f;
    const float low = max_fast(near, -reach), high = reach;
    if (!(low < min_fast(far, high))) return INFINITY;
    float ends[5];
    uint count = 0;
    const float bow2 = -torus.b * (1.0f / 6.0f); // the slope turns at its roots
    if (bow2 > 0.0f) {
        const float bow = sqrt(bow2), first = max_fast(low, min_fast(-bow, high));
        const float second = max_fast(low, min_fast(bow, high));
        count = add_turn(torus, low, first, ends, count);
        count = add_turn(torus, first, second, ends, count);
        count = add_turn(torus, second, high, ends, count);
    } else {
        count = add_turn(torus, low, high, ends, count);
    }
    ends[count] = high;
    float from = low, from_value = torus_value(torus, low);
    for (uint i = 0; i <= count; i++) {
        const float value = torus_value(torus, ends[i]);
        if ((from_value < 0.0f) != (value < 0.0f))
            return torus_root(torus, from, ends[i], from_value < 0.0f ? 1.0f : -1.0f);
        from = ends[i];
        from_value = value;
    }
    return INFINITY;
}

// The nearest distance in (t_min, t_max] at which the ray meets the shape, or infinity.
INLINE float shape_distance(BvhSphere shape, float3 origin, float t_min, float3 direction,
                            float t_max) {
    const CentredRay ray = centre_ray(origin, direction);
    const float near = fma(t_min, ray.scale, ray.start), far = fma(t_max, ray.scale, ray.start);
    float along;
    if (shape.kind == SHAPE_TORUS) {
        along = torus_distance(make_torus_ray(ray, shape.radius), near, far);
    } else {
        const float2 inside = shape.kind == SHAPE_DISK       ? in_disk(ray)
                              : shape.kind == SHAPE_CYLINDER ? in_cylinder(ray)
                              : shape.kind == SHAPE_CONE     ? in_cone(ray)
                                                             : in_unit_sphere(ray);
        if (!(inside.x <= inside.y)) return INFINITY;
        along = inside.x > near ? inside.x : inside.y;
    }
    if (!(along > near && along <= far)) return INFINITY;
    const float t = (along - ray.start) / ray.scale;
    return t > t_min && t <= t_max ? t : INFINITY;
}

#endif
