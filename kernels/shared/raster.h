// What the depth buffer and the painter know of a scene: primitives seen along parallel rays. A
// primitive is a triangle of an instance, or the near or the far half of a sphere.
#ifndef ONDE_SHARED_RASTER_H
#define ONDE_SHARED_RASTER_H

#include "shared/types.h"

#define RASTER_NONE 0xffffffffu
#define RASTER_TILE 64 // pixels along the side of a tile of the painter

// 64 bytes. Primitives are numbered through the instances' triangles in order, then the spheres'
// halves: near before far.
typedef struct {
    float background[3];
    uint width, height;
    uint instance_count;
    uint triangle_count;  // of all instances; the first half of the first sphere has this number
    uint primitive_count; // triangles and halves of spheres
    uint subpixels;       // of a pixel's side: corners of triangles are rounded to these, 1 to 256
    uint unused[7];
} RasterRecord;

// 64 bytes. A mesh placed in the view.
typedef struct {
    float to_screen[12]; // rows: x and y in pixels, y downward; depth in world units
    uint first_primitive;
    uint first_triangle; // of its mesh, among the triangles of all meshes
    uint unused[2];
} RasterInstance;

// 32 bytes. A sphere in the view.
typedef struct {
    float center[3];     // x and y in pixels, depth in world units
    float radius_pixels; // on the screen
    float radius;        // along the depth
    uint material;
    uint unused[2];
} RasterSphere;

// 32 bytes, one per material.
typedef struct {
    float color[3];
    uint texture; // multiplies the colour, or NO_INDEX
    float alpha;  // how much of what lies behind is hidden, in [0, 1]
    uint unused[3];
} RasterMaterial;

#endif
