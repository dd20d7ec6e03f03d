// A triangle that emits, uniform over its area.
#ifndef ONDE_SHADE_LIGHTS_TRIANGLE_H
#define ONDE_SHADE_LIGHTS_TRIANGLE_H

#include "shade/lights/flat.h"

INLINE FlatLight triangle_light(SceneView view, natural light) {
    const FlatLight f = LOAD_FLAT(view, light, triangle, corner, edge1, edge2);
    return f;
}

// A point of the light, by the weights of corners 1 and 2.
typedef struct {
    UvSets uv;
    real opacity;
} TrianglePoint;
INLINE TrianglePoint triangle_light_point(SceneView view, natural light, real2 b) {
    const mask own = RECORD_NATURAL(view.lights, light, LightRecord, kind) == (uint)LIGHT_TRIANGLE;
    const natural surface = RECORD_NATURAL(view.lights, light, LightRecord, surface);
    const Corners corners = triangle_corners(view, surface, own);
    TrianglePoint p;
    p.uv = triangle_uv(view, corners, b.x, b.y);
    p.opacity = material_opacity(view, LIGHT_MATERIAL(view, light), p.uv,
                                 triangle_alpha(view, corners, b.x, b.y));
    return p;
}

INLINE LightSample triangle_light_sample(SceneView view, natural light, real3 from, real2 u) {
    const real2 b = sample_triangle(u);
    const TrianglePoint p = triangle_light_point(view, light, b);
    return flat_sample(view, triangle_light(view, light), b, p.uv, p.opacity, from);
}
INLINE real triangle_light_pdf(SceneView view, natural light, real3 from, real3 direction, real t,
                               Surface s) {
    return area_pdf(t, dot3(s.geometric, direction), LIGHT_FIELD(view, light, triangle.area));
}
INLINE Emission triangle_light_emit(SceneView view, __global const LightTracingRecord* setup,
                                    natural light, real pmf, EmissionNumbers u) {
    const real2 b = sample_triangle(u.point);
    const TrianglePoint p = triangle_light_point(view, light, b);
    return flat_emit(view, triangle_light(view, light), b, p.uv, p.opacity, pmf, u);
}

#endif
