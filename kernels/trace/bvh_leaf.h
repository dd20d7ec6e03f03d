// A ray against what leaves hold: blocks of triangles, spheres, shapes, instances.
#ifndef ONDE_TRACE_BVH_LEAF_H
#define ONDE_TRACE_BVH_LEAF_H

// Whether a closest-hit traversal counts its tests (for heat maps and the laboratory).
#ifndef ONDE_TRAVERSAL_COST
    #define ONDE_TRAVERSAL_COST 0
#endif

// Whether rays go on behind hits that they have passed; see bvh_closest_behind.
#ifndef ONDE_PASSING
    #define ONDE_PASSING 0
#endif

#include "trace/shape.h"
#include "trace/triangle_watertight.h"

// A hit that a ray has passed; zeros where it has passed none.
typedef struct {
    float t;
    uint primitive, instance;
} PassedHit;

// A closest hit. primitive == BVH_NONE: nothing was hit, and t is the ray's t_max.
// u and v weigh the triangle's vertices 1 and 2; they are 0 on spheres. instance == BVH_NONE: the
// primitive lies in the world directly.
typedef struct {
    float t, u, v;
    uint primitive, instance;
#if ONDE_PASSING
    PassedHit passed; // only what lies behind it is hit
#endif
#if ONDE_TRAVERSAL_COST
    uint boxes, primitives; // that the traversal has tested
#endif
} Hit;

// A traversal's counters, where it counts: variables of their own, as a hit is replaced by closer
// ones.
#if ONDE_TRAVERSAL_COST
    #define DECLARE_COUNTERS uint boxes = 0, primitives = 0;
    #define COUNT_TESTS(counter, amount) counter += (amount)
    #define STORE_COUNTERS(hit)                                                                    \
        hit.boxes = boxes;                                                                         \
        hit.primitives = primitives;
#else
    #define DECLARE_COUNTERS
    #define COUNT_TESTS(counter, amount)
    #define STORE_COUNTERS(hit)
#endif

// Among hits at the same distance the smallest ids win, whatever the order in which they are found.
INLINE uint is_closer(float t, uint primitive, uint instance, Hit than) {
#if ONDE_PASSING
    const PassedHit passed = than.passed;
    if (t < passed.t) return 0;
    if (t == passed.t && (primitive < passed.primitive ||
                          (primitive == passed.primitive && instance <= passed.instance)))
        return 0;
#endif
    if (t != than.t) return t < than.t;
    return primitive < than.primitive || (primitive == than.primitive && instance < than.instance);
}

// A hit in place of another one of the ray.
INLINE Hit replace_hit(Hit hit, float t, float u, float v, uint primitive, uint instance) {
    Hit closer = {t, u, v, primitive, instance};
#if ONDE_PASSING
    closer.passed = hit.passed;
#endif
    return closer;
}

INLINE Vectors8 splat8(float3 v) {
    const Vectors8 vectors = {(float8)(v.x), (float8)(v.y), (float8)(v.z)};
    return vectors;
}
INLINE Vectors8 block_vectors(__global const float8* rows) {
    const Vectors8 vectors = {rows[0], rows[1], rows[2]};
    return vectors;
}

// What a block holds of its triangles' shape: corners 0 and edges, or three corners.
typedef struct {
    Vectors8 a, b, c;
} BlockTriangles;

INLINE BlockTriangles block_triangles(__global const uchar* block) {
    __global const float8* rows = (__global const float8*)block;
    const BlockTriangles triangles = {block_vectors(rows), block_vectors(rows + 3),
                                      block_vectors(rows + 6)};
    return triangles;
}
INLINE TriangleTest8 test_block(BlockTriangles triangles, float3 origin, float3 direction) {
    return leaf_test8(splat8(origin), splat8(direction), triangles.a, triangles.b, triangles.c);
}

// `hit`, or the closest of the hits that `test` and `miss` leave open.
INLINE Hit closest_of_block(__global const uchar* block, TriangleTest8 test, int8 miss, float t_min,
                            float near, uint instance, Hit hit) {
    const float8 inverse = 1.0f / test.determinant;
    const float8 t = test.t * inverse;
    const float8 from_box = max_fast(t, (float8)(near));
    int8 open = (miss >= 0) & (t > t_min);
#if ONDE_PASSING
    const uint8 ids = ((__global const uint8*)block)[9];
    const int8 later =
        instance > hit.passed.instance ? ids >= hit.passed.primitive : ids > hit.passed.primitive;
    open &= (from_box > hit.passed.t) | ((from_box == hit.passed.t) & later);
#endif
    const float8 candidate_t = open ? from_box : (float8)(INFINITY);
    const float closest = lowest_of8(candidate_t);
    if (!(closest <= hit.t) || closest == INFINITY) return hit;

    // The ids of a block ascend: its lowest lane has the smallest.
    const uint lane = lowest_bit(bits8(candidate_t == closest));
    const uint primitive = ((__global const uint*)block)[72 + lane];
    if (!is_closer(closest, primitive, instance, hit)) return hit;
    float u[8] __attribute__((aligned(32))), v[8] __attribute__((aligned(32)));
    *(float8*)u = test.u * inverse;
    *(float8*)v = test.v * inverse;
    return replace_hit(hit, closest, u[lane], v[lane], primitive, instance);
}

// `hit`, or the closest hit of the block's triangles in (t_min, hit.t]. A hit counts as no closer
// than `near`, where the ray enters the block's box: rounding may say otherwise, and the traversal
// of boxes would then find it or not depending on its order.
INLINE Hit closest_in_block(__global const uchar* block, float3 origin, float t_min,
                            float3 direction, float near, uint instance, Hit hit) {
    const TriangleTest8 test = test_block(block_triangles(block), origin, direction);
    const int8 miss = miss8(test, (float8)(t_min), (float8)(hit.t));
    if (sign_bits8(miss) == 0xffu) return hit;
    return closest_of_block(block, test, miss, t_min, near, instance, hit);
}

// Whether some triangle of the block is hit in (t_min, t_max].
INLINE uint any_in_block(__global const uchar* block, float3 origin, float t_min, float3 direction,
                         float t_max) {
    const TriangleTest8 test = test_block(block_triangles(block), origin, direction);
    const int8 miss = miss8(test, (float8)(t_min), (float8)(t_max));
    if (sign_bits8(miss) == 0xffu) return 0;
    const float8 t = test.t * (1.0f / test.determinant);
    return sign_bits8(as_int8(t_min - t) & ~(as_int8(t_max - t) | miss)) != 0;
}

// The nearest distance in (t_min, t_max] at which the ray meets the sphere, or infinity. The
// quadratic formula without cancellation of Haines et al., "Precision improvements for ray/sphere
// intersection", Ray Tracing Gems, 2019, chapter 7.
INLINE float sphere_distance(BvhSphere sphere, float3 origin, float t_min, float3 direction,
                             float t_max) {
    const float3 f = origin - (float3)(sphere.center[0], sphere.center[1], sphere.center[2]);
    const float a = dot_scalar(direction, direction);
    const float b = -dot_scalar(f, direction);
    const float3 foot = fma((float3)(b / a), direction, f);
    const float radius2 = sphere.radius * sphere.radius;
    const float discriminant = a * (radius2 - dot_scalar(foot, foot));
    if (!(discriminant >= 0.0f)) return INFINITY;
    const float q = b + copysign(sqrt(discriminant), b);
    const float c = dot_scalar(f, f) - radius2;
    const float t0 = c / q, t1 = q / a;
    const float first = min_fast(t0, t1), second = max_fast(t0, t1);
    if (first > t_min && first <= t_max) return first;
    return second > t_min && second <= t_max ? second : INFINITY;
}

// As closest_in_block, of one primitive that is hit at `distance`, or not where that is infinite.
INLINE Hit closest_at(float distance, uint primitive, float near, uint instance, Hit hit) {
    if (distance == INFINITY) return hit;
    const float t = max_fast(distance, near);
    if (!is_closer(t, primitive, instance, hit)) return hit;
    return replace_hit(hit, t, 0.0f, 0.0f, primitive, instance);
}
// A ray that has passed the front of a round thing may hit its back.
INLINE float behind_passed(float t_min, Hit hit) {
#if ONDE_PASSING
    return max_fast(t_min, hit.passed.t);
#else
    return t_min;
#endif
}
INLINE Hit closest_on_sphere(BvhSphere sphere, float3 origin, float t_min, float3 direction,
                             float near, uint instance, Hit hit) {
    t_min = behind_passed(t_min, hit);
    const float distance = sphere_distance(sphere, origin, t_min, direction, hit.t);
    return closest_at(distance, sphere.primitive, near, instance, hit);
}
INLINE Hit closest_on_shape(BvhSphere shape, float3 origin, float t_min, float3 direction,
                            float near, uint instance, Hit hit) {
    t_min = behind_passed(t_min, hit);
    const float distance = shape_distance(shape, origin, t_min, direction, hit.t);
    return closest_at(distance, shape.primitive, near, instance, hit);
}

// Rows of a 3x4 matrix times (p, 1), or (v, 0).
INLINE float3 transform_point(__global const float* rows, float3 p) {
    return (float3)(fma(rows[0], p.x, fma(rows[1], p.y, fma(rows[2], p.z, rows[3]))),
                    fma(rows[4], p.x, fma(rows[5], p.y, fma(rows[6], p.z, rows[7]))),
                    fma(rows[8], p.x, fma(rows[9], p.y, fma(rows[10], p.z, rows[11]))));
}
INLINE float3 transform_vector(__global const float* rows, float3 v) {
    return (float3)(fma(rows[0], v.x, fma(rows[1], v.y, rows[2] * v.z)),
                    fma(rows[4], v.x, fma(rows[5], v.y, rows[6] * v.z)),
                    fma(rows[8], v.x, fma(rows[9], v.y, rows[10] * v.z)));
}

#endif
