// A primitive, whatever it is: the rows and columns that it covers and its depth at a pixel.
#ifndef ONDE_CHAPTER_RASTER_PRIMITIVE_H
#define ONDE_CHAPTER_RASTER_PRIMITIVE_H

#include "chapter/raster/half_sphere.h"
#include "chapter/raster/triangle.h"

typedef struct {
    bool round; // a half sphere
    Triangle triangle;
    HalfSphere half_sphere;
    Span columns, rows; // a box around it, cut at the picture's borders; empty: nothing to draw
} Primitive;

INLINE Primitive load_primitive(RasterView view, uint number) {
    const Span width = make_span(0, (int)view.record->width);
    const Span height = make_span(0, (int)view.record->height);
    Primitive p;
    p.round = number >= view.record->triangle_count;
    if (p.round) {
        p.half_sphere = load_half_sphere(view, number);
        p.columns = around(p.half_sphere.x, p.half_sphere.radius_pixels, width);
        p.rows = around(p.half_sphere.y, p.half_sphere.radius_pixels, height);
        return p;
    }
    p.triangle = load_triangle(view, number);
    p.columns = common_span(pixel_range(p.triangle.x, p.triangle.subpixels), width);
    p.rows = common_span(pixel_range(p.triangle.y, p.triangle.subpixels), height);
    if (p.triangle.area == 0) p.rows.end = p.rows.begin;
    return p;
}

// Pixels of the box around it.
INLINE uint box_size(const Primitive* p) {
    if (p->columns.end <= p->columns.begin || p->rows.end <= p->rows.begin) return 0;
    return (uint)(p->columns.end - p->columns.begin) * (uint)(p->rows.end - p->rows.begin);
}

INLINE Span primitive_span(const Primitive* p, int row, Span columns) {
    return p->round ? half_sphere_span(&p->half_sphere, row, columns)
                    : triangle_span(&p->triangle, row, columns);
}

// Along the view, in world units.
INLINE float primitive_depth(const Primitive* p, int column, int row) {
    return p->round ? half_sphere_depth(&p->half_sphere, column, row)
                    : triangle_depth(&p->triangle, column, row);
}

// Whether the camera can see something at this depth: rays start at depth 0.
INLINE bool depth_visible(float depth) {
    return depth > 0.0f && depth < MAXFLOAT;
}

#endif
