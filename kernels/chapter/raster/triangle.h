// Triangles on the screen: which pixels they cover, exactly, and how deep they lie there. Corners
// are rounded to sub-pixels; all that follows is integer arithmetic, so triangles that share an
// edge leave no gap and cover no pixel twice (Pineda, "A parallel algorithm for polygon
// rasterization", 1988).
#ifndef ONDE_CHAPTER_RASTER_TRIANGLE_H
#define ONDE_CHAPTER_RASTER_TRIANGLE_H

#include "chapter/raster/view.h"

typedef struct {
    int x[3], y[3]; // in sub-pixels from the sample of pixel (0, 0), turning so that area >= 0
    float z[3];
    uint vertex[3];
    int subpixels;
    long area; // twice the area in square sub-pixels; 0: covers nothing
} Triangle;

// The instance that holds a triangle primitive: the last one that starts at or before it.
INLINE uint find_instance(RasterView view, uint primitive) {
    uint low = 0, high = view.record->instance_count;
    while (high - low > 1) {
        const uint middle = low + (high - low) / 2;
        if (view.instances[middle].first_primitive <= primitive)
            low = middle;
        else
            high = middle;
    }
    return low;
}

// The triangle's place among the triangles of all meshes.
INLINE uint mesh_triangle(__global const RasterInstance* instance, uint primitive) {
    return instance->first_triangle + (primitive - instance->first_primitive);
}

INLINE float row_dot(__global const float* row, __global const float* p) {
    return fma(row[2], p[2], fma(row[1], p[1], fma(row[0], p[0], row[3])));
}

INLINE void place_corner(RasterView view, __global const RasterInstance* instance, uint vertex,
                         Triangle* t, uint corner) {
    __global const float* p = view.positions + 3 * (size_t)vertex;
    const float scale = (float)t->subpixels;
    t->vertex[corner] = vertex;
    t->x[corner] = (int)rint((row_dot(instance->to_screen, p) - view.offset_x) * scale);
    t->y[corner] = (int)rint((row_dot(instance->to_screen + 4, p) - view.offset_y) * scale);
    t->z[corner] = row_dot(instance->to_screen + 8, p);
}

INLINE void swap_corners(Triangle* t) {
    const int x = t->x[1], y = t->y[1];
    const float z = t->z[1];
    const uint vertex = t->vertex[1];
    t->x[1] = t->x[2], t->y[1] = t->y[2], t->z[1] = t->z[2], t->vertex[1] = t->vertex[2];
    t->x[2] = x, t->y[2] = y, t->z[2] = z, t->vertex[2] = vertex;
}

// Twice the area of the triangle of an edge, from corner a to corner b, and a point in sub-pixels.
INLINE long edge_area(const Triangle* t, uint a, uint b, long x, long y) {
    return (long)(t->x[b] - t->x[a]) * (y - t->y[a]) - (long)(t->y[b] - t->y[a]) * (x - t->x[a]);
}

INLINE Triangle load_triangle(RasterView view, uint primitive) {
    __global const RasterInstance* instance = view.instances + find_instance(view, primitive);
    __global const uint* corners = view.triangles + 3 * (size_t)mesh_triangle(instance, primitive);
    Triangle t;
    t.subpixels = (int)view.record->subpixels;
    for (uint corner = 0; corner < 3; corner++)
        place_corner(view, instance, corners[corner], &t, corner);
    t.area = edge_area(&t, 0, 1, t.x[2], t.y[2]);
    if (t.area < 0) {
        swap_corners(&t);
        t.area = -t.area;
    }
    return t;
}

INLINE long floor_divide(long a, long b) {
    const long q = a / b;
    return q * b > a ? q - 1 : q; // b > 0
}

// The first pixel at or after a place in sub-pixels.
INLINE int first_pixel(int place, int subpixels) {
    return (int)floor_divide((long)place + subpixels - 1, subpixels);
}

INLINE Span pixel_range(const int* places, int subpixels) {
    const int low = min(places[0], min(places[1], places[2]));
    const int high = max(places[0], max(places[1], places[2]));
    return make_span(first_pixel(low, subpixels), (int)floor_divide(high, subpixels) + 1);
}

// Narrows a span of columns to those on the inner side of an edge. On the edge itself a pixel
// belongs to the triangle on the right, or below: so says the sign of the edge's direction.
INLINE Span clip_to_edge(const Triangle* t, uint a, uint b, int row, Span span) {
    const int across = t->x[b] - t->x[a], down = t->y[b] - t->y[a];
    const bool owns_edge = down < 0 || (down == 0 && across > 0);
    const long start = edge_area(t, a, b, 0, (long)row * t->subpixels) - (owns_edge ? 0 : 1);
    const long step = (long)down * t->subpixels; // start - column * step >= 0 is inside
    if (step == 0) return start >= 0 ? span : make_span(0, 0);
    const long crossing = step > 0 ? floor_divide(start, step) + 1 : -floor_divide(start, -step);
    const int column = (int)clamp(crossing, (long)span.begin, (long)span.end);
    return step > 0 ? make_span(span.begin, column) : make_span(column, span.end);
}

// The columns of a row that the triangle covers, within `columns`.
INLINE Span triangle_span(const Triangle* t, int row, Span columns) {
    Span span = clip_to_edge(t, 0, 1, row, columns);
    span = clip_to_edge(t, 1, 2, row, span);
    return clip_to_edge(t, 2, 0, row, span);
}

// The weights of corners 1 and 2 at a pixel.
INLINE float2 triangle_weights(const Triangle* t, int column, int row) {
    const long x = (long)column * t->subpixels, y = (long)row * t->subpixels;
    const float scale = 1.0f / (float)t->area;
    return (float2)((float)edge_area(t, 2, 0, x, y) * scale,
                    (float)edge_area(t, 0, 1, x, y) * scale);
}

INLINE float triangle_depth(const Triangle* t, int column, int row) {
    const float2 w = triangle_weights(t, column, row);
    return fma(w.y, t->z[2] - t->z[0], fma(w.x, t->z[1] - t->z[0], t->z[0]));
}

#endif
