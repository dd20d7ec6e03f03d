// The primitives as the raster kernels see them, and the sample that is drawn.
#ifndef ONDE_CHAPTER_RASTER_VIEW_H
#define ONDE_CHAPTER_RASTER_VIEW_H

#include "math/lanes.h"
#include "shared/raster.h"

typedef struct {
    __global const RasterRecord* record;
    __global const RasterInstance* instances;
    __global const float* positions; // 3 a vertex
    __global const uint* triangles;  // 3 vertices each
    __global const uint* triangle_materials;
    __global const RasterSphere* spheres;
    __global const RasterMaterial* materials;
    __global const float* uvs; // 2 a vertex, where the scene has textures
    float offset_x, offset_y;  // of the sample in its pixel, in [0, 1)
} RasterView;

// The same as kernel parameters, in the order in which the host binds them.
#define RASTER_PARAMETERS                                                                          \
    __global const RasterRecord *record, __global const RasterInstance *raster_instances,          \
        __global const float *positions, __global const uint *triangles,                           \
        __global const uint *triangle_materials, __global const RasterSphere *raster_spheres,      \
        __global const RasterMaterial *raster_materials, __global const float *raster_uvs,         \
        float offset_x, float offset_y

#define RASTER_VIEW(view)                                                                          \
    RasterView view;                                                                               \
    view.record = record;                                                                          \
    view.instances = raster_instances;                                                             \
    view.positions = positions;                                                                    \
    view.triangles = triangles;                                                                    \
    view.triangle_materials = triangle_materials;                                                  \
    view.spheres = raster_spheres;                                                                 \
    view.materials = raster_materials;                                                             \
    view.uvs = raster_uvs;                                                                         \
    view.offset_x = offset_x;                                                                      \
    view.offset_y = offset_y

// Columns or rows first to end - 1.
typedef struct {
    int begin, end;
} Span;

INLINE Span make_span(int begin, int end) {
    Span span;
    span.begin = begin;
    span.end = end;
    return span;
}
INLINE Span common_span(Span a, Span b) {
    const int begin = max(a.begin, b.begin);
    return make_span(begin, max(begin, min(a.end, b.end)));
}

#endif
