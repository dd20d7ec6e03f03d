// What a triangle's corners have, interpolated at a hit: normals, texture coordinates, colours,
// tangents.
#ifndef ONDE_SHADE_CORNERS_H
#define ONDE_SHADE_CORNERS_H

#include "shade/placement.h"
#include "shade/texture.h"

// Where the corners of a triangle are among the vertices; the first vertex for other surfaces.
typedef struct {
    natural vertex[3];
} Corners;

INLINE Corners triangle_corners(SceneView view, natural record, mask triangle) {
    const natural zero = (natural)(0u);
    Corners c;
    c.vertex[0] = choose(triangle, SURFACE_NATURAL(view, record, triangle.vertex[0]), zero);
    c.vertex[1] = choose(triangle, SURFACE_NATURAL(view, record, triangle.vertex[1]), zero);
    c.vertex[2] = choose(triangle, SURFACE_NATURAL(view, record, triangle.vertex[2]), zero);
    return c;
}

INLINE real3 corner_normal(SceneView view, natural vertex) {
    return decode_octahedral(RECORD_NATURAL(view.vertices, vertex, VertexRecord, normal));
}
// u and v are the weights of corners 1 and 2.
INLINE real3 triangle_normal(SceneView view, Corners c, real u, real v) {
    const real3 n0 = corner_normal(view, c.vertex[0]), n1 = corner_normal(view, c.vertex[1]);
    const real3 n2 = corner_normal(view, c.vertex[2]);
    return normalize3(madd3(n2, v, madd3(n1, u, scale3(n0, 1.0f - u - v))));
}
// A number of the sets of texture coordinates after the first.
INLINE real interpolate_further(SceneView view, Corners c, uint number, real u, real v) {
    const uint stride = 2 * (ONDE_UV_SETS - 1);
    const real n0 = gather_real(view.uvs, c.vertex[0] * stride + number);
    const real n1 = gather_real(view.uvs, c.vertex[1] * stride + number);
    const real n2 = gather_real(view.uvs, c.vertex[2] * stride + number);
    return fma(n2, v, fma(n1, u, n0 * (1.0f - u - v)));
}
INLINE UvSets triangle_uv(SceneView view, Corners c, real u, real v) {
    UvSets uvs = same_in_all_sets(make2((real)(0.0f), (real)(0.0f)));
#if ONDE_TEXTURES || ONDE_UV
    const real w = 1.0f - u - v;
    real2 uv;
    uv.x = RECORD(view.vertices, c.vertex[2], VertexRecord, uv[0]) * v;
    uv.x = fma(RECORD(view.vertices, c.vertex[1], VertexRecord, uv[0]), u, uv.x);
    uv.x = fma(RECORD(view.vertices, c.vertex[0], VertexRecord, uv[0]), w, uv.x);
    uv.y = RECORD(view.vertices, c.vertex[2], VertexRecord, uv[1]) * v;
    uv.y = fma(RECORD(view.vertices, c.vertex[1], VertexRecord, uv[1]), u, uv.y);
    uv.y = fma(RECORD(view.vertices, c.vertex[0], VertexRecord, uv[1]), w, uv.y);
    uvs.set[0] = uv;
    for (uint k = 1; k < ONDE_UV_SETS; k++) {
        uvs.set[k].x = interpolate_further(view, c, 2 * (k - 1), u, v);
        uvs.set[k].y = interpolate_further(view, c, 2 * (k - 1) + 1, u, v);
    }
#endif
    return uvs;
}

#if ONDE_VERTEX_COLORS
// Two of the colour's 16-bit channels.
typedef struct {
    real low, high;
} Channels;

INLINE Channels corner_channels(SceneView view, natural vertex, uint word) {
    const natural bits = gather_natural(view.colors, vertex * 2u + word);
    Channels c;
    c.low = to_real(bits & 0xffffu) * (1.0f / 65535.0f);
    c.high = to_real(bits >> 16) * (1.0f / 65535.0f);
    return c;
}
INLINE Channels triangle_channels(SceneView view, Corners c, uint word, real u, real v) {
    const Channels c0 = corner_channels(view, c.vertex[0], word);
    const Channels c1 = corner_channels(view, c.vertex[1], word);
    const Channels c2 = corner_channels(view, c.vertex[2], word);
    const real w = 1.0f - u - v;
    Channels mean;
    mean.low = fma(c2.low, v, fma(c1.low, u, c0.low * w));
    mean.high = fma(c2.high, v, fma(c1.high, u, c0.high * w));
    return mean;
}
#endif

// The colour of a triangle's vertices, and its alpha.
INLINE real3 triangle_tint(SceneView view, Corners c, real u, real v) {
#if ONDE_VERTEX_COLORS
    const Channels red_green = triangle_channels(view, c, 0, u, v);
    return make3(red_green.low, red_green.high, triangle_channels(view, c, 1, u, v).low);
#else
    return splat3((real)(1.0f));
#endif
}
INLINE real triangle_alpha(SceneView view, Corners c, real u, real v) {
#if ONDE_VERTEX_COLORS
    return triangle_channels(view, c, 1, u, v).high;
#else
    return (real)(1.0f);
#endif
}

#endif
