// The painter's algorithm (chapter 1.2): primitives from far to near, each blended over what is
// there, with no depth test. Per tile of the picture a list of what may touch it, in that order;
// a work item paints some rows of a tile, so no pixel has two painters.
#include "chapter/raster/color.h"
#include "chapter/raster/scan.h"
#include "chapter/raster/sort_key.h"
#include "film/job.h"
#include "film/splat.h"

// Depth of the centre of mass; that of half a sphere's surface lies half a radius off.
INLINE float center_depth(RasterView view, uint number) {
    if (number >= view.record->triangle_count) {
        const HalfSphere h = load_half_sphere(view, number);
        return fma(0.5f, h.reach, h.z);
    }
    const Triangle t = load_triangle(view, number);
    return (t.z[0] + t.z[1] + t.z[2]) * (1.0f / 3.0f);
}

__kernel void depth_keys(uint count, uint chunk, RASTER_PARAMETERS, __global uint* keys,
                         __global uint* order) {
    if (count == 0) return;
    RASTER_VIEW(view);
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++) {
        keys[i] = far_to_near_key(center_depth(view, i));
        order[i] = i;
    }
}

// Columns begin, end and rows begin, end of the tiles that a primitive's box touches.
INLINE ushort4 touched_tiles(const Primitive* p) {
    if (box_size(p) == 0) return (ushort4)(0);
    return (ushort4)((ushort)(p->columns.begin / RASTER_TILE),
                     (ushort)((p->columns.end - 1) / RASTER_TILE + 1),
                     (ushort)(p->rows.begin / RASTER_TILE),
                     (ushort)((p->rows.end - 1) / RASTER_TILE + 1));
}

// By primitive, so that the two kernels below, which go by the order, read 8 bytes each.
__kernel void find_tiles(uint count, uint chunk, RASTER_PARAMETERS, __global ushort4* touched) {
    if (count == 0) return;
    RASTER_VIEW(view);
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++) {
        const Primitive p = load_primitive(view, i);
        touched[i] = touched_tiles(&p);
    }
}

// Counts, by block and tile, the primitives that touch the tile: those at `first` to
// first + count - 1 of the order, `block` per work item.
__kernel void count_tiles(uint count, uint block, uint first, __global const uint* order,
                          __global const ushort4* touched, uint tiles_across, uint tiles,
                          __global uint* table) {
    const Range range = whole_range(count, block);
    if (range.begin == range.end) return;
    __global uint* row = table + get_global_id(0) * (size_t)tiles;
    for (uint t = 0; t < tiles; t++) row[t] = 0;
    for (uint i = range.begin; i < range.end; i++) {
        const ushort4 box = touched[order[first + i]];
        for (uint y = box.z; y < box.w; y++)
            for (uint x = box.x; x < box.y; x++) row[y * tiles_across + x]++;
    }
}

// Writes the lists. table: as scanned, how many of earlier blocks a tile has; begins: by tile.
__kernel void fill_tiles(uint count, uint block, uint first, __global const uint* order,
                         __global const ushort4* touched, uint tiles_across, uint tiles,
                         __global uint* table, __global const uint* begins, __global uint* lists) {
    const Range range = whole_range(count, block);
    if (range.begin == range.end) return;
    __global uint* row = table + get_global_id(0) * (size_t)tiles;
    for (uint i = range.begin; i < range.end; i++) {
        const uint number = order[first + i];
        const ushort4 box = touched[number];
        for (uint y = box.z; y < box.w; y++)
            for (uint x = box.x; x < box.y; x++) {
                const uint t = y * tiles_across + x;
                lists[begins[t] + row[t]++] = number;
            }
    }
}

__kernel void clear_canvas(uint count, uint chunk, RASTER_PARAMETERS, __global float4* canvas) {
    if (count == 0) return;
    RASTER_VIEW(view);
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++)
        canvas[i] = (float4)(background_color(view), 0.0f);
}

// Blends a primitive over part of a row. The canvas counts its fragments in w.
INLINE void paint_span(RasterView view, SceneView scene, const Primitive* p, uint material, int row,
                       Span span, __global float4* canvas) {
    const float alpha = view.materials[material].alpha;
    for (int column = span.begin; column < span.end; column++) {
        if (!depth_visible(primitive_depth(p, column, row))) continue;
        __global float4* pixel = canvas + (size_t)row * view.record->width + (uint)column;
        const float3 color = color_at(view, scene, p, material, column, row);
        const float3 blended = fma((float3)(1.0f - alpha), pixel->xyz, color * alpha);
        *pixel = (float4)(blended, pixel->w + 1.0f);
    }
}

// `rows` rows of a tile per work item, the lists from their begins on; begins has one more entry
// than there are tiles.
__kernel void paint_tiles(uint count, SCENE_PARAMETERS, uint rows, RASTER_PARAMETERS,
                          uint tiles_across, __global const uint* begins,
                          __global const uint* lists, __global float4* canvas) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    SCENE_VIEW(scene);
    RASTER_VIEW(view);
    const uint parts = RASTER_TILE / rows, tile = item / parts;
    const int left = (int)(tile % tiles_across * RASTER_TILE);
    const int top = (int)(tile / tiles_across * RASTER_TILE + item % parts * rows);
    const Span own_columns = make_span(left, left + RASTER_TILE),
               own_rows = make_span(top, top + (int)rows);
    for (uint i = begins[tile]; i < begins[tile + 1]; i++) {
        const Primitive p = load_primitive(view, lists[i]);
        const uint material = primitive_material(view, lists[i]);
        const Span columns = common_span(own_columns, p.columns);
        const Span touched = common_span(own_rows, p.rows);
        for (int row = touched.begin; row < touched.end; row++)
            paint_span(view, scene, &p, material, row, primitive_span(&p, row, columns), canvas);
    }
}

// Adds the sample to the film, and to the statistics the numbers of fragments and of pixels that
// have any: two 64-bit sums.
__kernel void resolve_canvas(uint count, uint chunk, __global const float4* canvas,
                             __global float4* film_sums, __global uint* statistics) {
    const Range range = whole_range(count, chunk);
    ulong fragments = 0;
    uint covered = 0;
    for (uint i = range.begin; i < range.end; i++) {
        film_sums[i] += (float4)(canvas[i].xyz, 1.0f);
        fragments += (ulong)canvas[i].w;
        covered += canvas[i].w > 0.0f;
    }
    if (covered == 0) return;
    sum_add(statistics, (uint)fragments, (uint)(fragments >> 32));
    sum_add(statistics + 2, covered, 0);
}
