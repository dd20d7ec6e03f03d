// The depth buffer (chapter 1.1): every fragment of every primitive tries its pixel, the nearest
// stays, of equally near ones that of the lowest number; so no order of drawing changes a bit.
// 8 bytes a pixel: the primitive's number, then the depth, whose bits are in the order of numbers.
#include "chapter/raster/color.h"
#include "film/job.h"

#define DEPTH_CLEARED 0xffffffffffffffffUL

// With 64-bit atomics both words are settled in one pass. Without them the pass of PHASE_DEPTH
// settles the depths, that of PHASE_NUMBER the numbers among those that are as near.
#define PHASE_DEPTH 0u
#define PHASE_NUMBER 1u

#ifndef ONDE_DEPTH_ATOMICS64
    #define ONDE_DEPTH_ATOMICS64 0
#endif

#if ONDE_DEPTH_ATOMICS64
    #pragma OPENCL EXTENSION cl_khr_int64_extended_atomics : enable
#endif

INLINE void keep_nearest(volatile __global ulong* nearest, size_t pixel, float depth, uint number,
                         uint phase) {
    volatile __global uint* words = (volatile __global uint*)&nearest[pixel];
    const uint bits = as_uint(depth);
#if ONDE_DEPTH_ATOMICS64
    // A depth of 32 bits is read whole on every device, and one that is out of date is larger.
    if (bits <= words[1]) atom_min(&nearest[pixel], (ulong)bits << 32 | number);
#else
    if (phase == PHASE_DEPTH)
        atomic_min(&words[1], bits);
    else if (words[1] == bits)
        atomic_min(&words[0], number);
#endif
}

// The fragments of a primitive in some rows and columns.
INLINE void draw_fragments(const Primitive* p, uint number, Span rows, Span columns, uint width,
                           volatile __global ulong* nearest, uint phase) {
    rows = common_span(rows, p->rows);
    columns = common_span(columns, p->columns);
    for (int row = rows.begin; row < rows.end; row++) {
        const Span span = primitive_span(p, row, columns);
        for (int column = span.begin; column < span.end; column++) {
            const float depth = primitive_depth(p, column, row);
            if (!depth_visible(depth)) continue;
            keep_nearest(nearest, (size_t)row * width + (uint)column, depth, number, phase);
        }
    }
}

__kernel void clear_depth(uint count, uint chunk, __global ulong* nearest) {
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++) nearest[i] = DEPTH_CLEARED;
}

// `count` primitives from `first` on, `chunk` of them per work item. Those whose box has more than
// `most_pixels` are put on the list of large ones instead, in any order; large[0] is its length.
__kernel void draw_small(uint count, uint chunk, RASTER_PARAMETERS, uint first, uint most_pixels,
                         __global uint* large, __global ulong* nearest, uint phase) {
    if (count == 0) return;
    RASTER_VIEW(view);
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++) {
        const Primitive p = load_primitive(view, first + i);
        const uint size = box_size(&p);
        if (size == 0) continue;
        if (size > most_pixels)
            large[1 + atomic_inc(large)] = first + i;
        else
            draw_fragments(&p, first + i, p.rows, p.columns, record->width, nearest, phase);
    }
}

// The large ones, cut into `count` bands of `band` rows: a work item draws its rows of them all.
__kernel void draw_large(uint count, uint band, RASTER_PARAMETERS, __global const uint* large,
                         __global ulong* nearest, uint phase) {
    if (get_global_id(0) >= count) return;
    RASTER_VIEW(view);
    const int top = (int)(get_global_id(0) * band);
    const Span rows = make_span(top, top + (int)band);
    for (uint i = 0; i < large[0]; i++) {
        const uint number = large[1 + i];
        const Primitive p = load_primitive(view, number);
        draw_fragments(&p, number, rows, p.columns, record->width, nearest, phase);
    }
}

INLINE float3 nearest_color(RasterView view, SceneView scene, uint number, uint pixel) {
    if (number == RASTER_NONE) return background_color(view);
    const uint material = primitive_material(view, number);
#if ONDE_TEXTURES
    const Primitive p = load_primitive(view, number);
    return color_at(view, scene, &p, material, (int)(pixel % view.record->width),
                    (int)(pixel / view.record->width));
#else
    return base_color(view, material);
#endif
}

// Adds the sample to the film: `count` pixels, `chunk` of them per work item.
__kernel void resolve_depth(uint count, SCENE_PARAMETERS, uint chunk, RASTER_PARAMETERS,
                            __global const ulong* nearest, __global float4* film_sums) {
    if (count == 0) return;
    SCENE_VIEW(scene);
    RASTER_VIEW(view);
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++)
        film_sums[i] += (float4)(nearest_color(view, scene, (uint)nearest[i], i), 1.0f);
}
