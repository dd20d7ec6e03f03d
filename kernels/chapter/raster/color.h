// The colour of a primitive: its material's base colour, times its texture. No light.
#ifndef ONDE_CHAPTER_RASTER_COLOR_H
#define ONDE_CHAPTER_RASTER_COLOR_H

#include "chapter/raster/primitive.h"
#include "shade/texture.h"

INLINE uint primitive_material(RasterView view, uint number) {
    if (number >= view.record->triangle_count)
        return view.spheres[(number - view.record->triangle_count) / 2].material;
    __global const RasterInstance* instance = view.instances + find_instance(view, number);
    return view.triangle_materials[mesh_triangle(instance, number)];
}

INLINE float3 base_color(RasterView view, uint material) {
    __global const float* color = view.materials[material].color;
    return (float3)(color[0], color[1], color[2]);
}

INLINE real2 triangle_uv(RasterView view, const Triangle* t, int column, int row) {
    const float2 w = triangle_weights(t, column, row);
    __global const float* a = view.uvs + 2 * (size_t)t->vertex[0];
    __global const float* b = view.uvs + 2 * (size_t)t->vertex[1];
    __global const float* c = view.uvs + 2 * (size_t)t->vertex[2];
    return make2(fma(w.y, c[0] - a[0], fma(w.x, b[0] - a[0], a[0])),
                 fma(w.y, c[1] - a[1], fma(w.x, b[1] - a[1], a[1])));
}

// The colour of a primitive at a pixel. Spheres have no texture coordinates and no texture.
INLINE float3 color_at(RasterView view, SceneView scene, const Primitive* p, uint material,
                       int column, int row) {
    const float3 color = base_color(view, material);
#if ONDE_TEXTURES
    const uint texture = view.materials[material].texture;
    if (texture == NO_INDEX || p->round) return color;
    const real3 factor = texture_color(
        scene, texture, same_in_all_sets(triangle_uv(view, &p->triangle, column, row)));
    return color * (float3)(factor.x, factor.y, factor.z);
#else
    return color;
#endif
}

INLINE float3 background_color(RasterView view) {
    __global const float* color = view.record->background;
    return (float3)(color[0], color[1], color[2]);
}

#endif
