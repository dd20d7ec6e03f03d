// The near and the far half of a sphere, seen along parallel rays: the same disk, two depths.
#ifndef ONDE_CHAPTER_RASTER_HALF_SPHERE_H
#define ONDE_CHAPTER_RASTER_HALF_SPHERE_H

#include "chapter/raster/view.h"

typedef struct {
    float x, y, z;       // of the centre; x and y from the sample of pixel (0, 0)
    float radius_pixels; // on the screen
    float reach;         // radius along the depth, negative for the near half
    uint material;
} HalfSphere;

INLINE HalfSphere load_half_sphere(RasterView view, uint primitive) {
    const uint half_number = primitive - view.record->triangle_count;
    __global const RasterSphere* sphere = view.spheres + half_number / 2;
    HalfSphere h;
    h.x = sphere->center[0] - view.offset_x;
    h.y = sphere->center[1] - view.offset_y;
    h.z = sphere->center[2];
    h.radius_pixels = sphere->radius_pixels;
    h.reach = half_number % 2 == 0 ? -sphere->radius : sphere->radius;
    h.material = sphere->material;
    return h;
}

// The whole numbers in [center - reach, center + reach], within `bounds`.
INLINE Span around(float center, float reach, Span bounds) {
    const float low = (float)bounds.begin - 1.0f, high = (float)bounds.end + 1.0f;
    return common_span(make_span((int)ceil(clamp(center - reach, low, high)),
                                 (int)floor(clamp(center + reach, low, high)) + 1),
                       bounds);
}

INLINE Span half_sphere_span(const HalfSphere* h, int row, Span columns) {
    const float down = (float)row - h->y;
    const float square = fma(h->radius_pixels, h->radius_pixels, -(down * down));
    if (!(square > 0.0f)) return make_span(0, 0);
    return around(h->x, sqrt(square), columns);
}

INLINE float half_sphere_depth(const HalfSphere* h, int column, int row) {
    const float u = ((float)column - h->x) / h->radius_pixels;
    const float v = ((float)row - h->y) / h->radius_pixels;
    const float square = 1.0f - fma(u, u, v * v);
    return fma(h->reach, sqrt(max(square, 0.0f)), h->z);
}

#endif
