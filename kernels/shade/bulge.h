// How far the curved surface that a triangle stands for, by its corners' normals, rises above it.
//
// Light that such a surface would still see comes to the triangle from below its plane, where
// nothing can be seen: a border of whole triangles where shading says that light fades out slowly.
// Rays in these directions begin on the curved surface (Hanika, "Hacking the Shadow Terminator",
// Ray Tracing Gems II, 2021); whatever is in their way is met as ever. All other rays begin on the
// triangle.
#ifndef ONDE_SHADE_BULGE_H
#define ONDE_SHADE_BULGE_H

#include "shade/scene_view.h"

#if ONDE_CURVED
// What one edge adds: its number of units from bits of the word, as src/upload/bulge.h has them.
INLINE real edge_bulge(natural bits, real side, real weight) {
    const real units = to_real(bits & 255u) - 128.0f;
    return max_real(units * side, (real)(0.0f)) * weight;
}

// On the front, or on the back, at weights u and v of corners 1 and 2. In object space.
INLINE real triangle_bulge(SceneView view, natural record, real u, real v, mask front) {
    const natural word = gather_natural(view.bulges, record);
    const real w = 1.0f - u - v, side = choose(front, (real)(1.0f), (real)(-1.0f));
    const real units = edge_bulge(word, side, w * u) + edge_bulge(word >> 8, side, u * v) +
                       edge_bulge(word >> 16, side, v * w);
    return units * as_real((word >> 24) << 23);
}
#endif

#endif
