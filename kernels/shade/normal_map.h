// Normals bent by a texture.
#ifndef ONDE_SHADE_NORMAL_MAP_H
#define ONDE_SHADE_NORMAL_MAP_H

#include "shade/corners.h"

#if ONDE_NORMAL_MAPS
INLINE real3 corner_direction(natural word) {
    return decode_octahedral(word & ~1u);
}
// u and v are the weights of corners 1 and 2, which share the sign.
INLINE Tangent triangle_tangent(SceneView view, Corners c, real u, real v) {
    const natural word = gather_natural(view.tangents, c.vertex[0]);
    const real3 t0 = corner_direction(word);
    const real3 t1 = corner_direction(gather_natural(view.tangents, c.vertex[1]));
    const real3 t2 = corner_direction(gather_natural(view.tangents, c.vertex[2]));
    Tangent t;
    t.sign = choose((word & 1u) != 0u, (real)(-1.0f), (real)(1.0f));
    t.direction = madd3(t2, v, madd3(t1, u, scale3(t0, 1.0f - u - v)));
    return t;
}

// The normal told by a normal map (glTF 2.0, section 3.9.3), or n where there is none.
INLINE real3 mapped_normal(SceneView view, Placement placement, Corners corners, real u, real v,
                           natural texture, real scale, UvSets uv, real3 n) {
    const mask present = texture != NO_INDEX;
    if (!mask_bits(present)) return n;
    real3 m = texture_data(view, texture, uv);
    m = make3(fma(m.x, (real)(2.0f), (real)(-1.0f)) * scale,
              fma(m.y, (real)(2.0f), (real)(-1.0f)) * scale, fma(m.z, (real)(2.0f), (real)(-1.0f)));
    const Tangent frame = placed_tangent(view, placement, triangle_tangent(view, corners, u, v));
    real3 tangent = frame.direction;
    tangent = madd3(n, -dot3(n, tangent), tangent);
    const real across = length3(tangent);
    const real3 t = scale3(tangent, 1.0f / max_real(across, (real)(1e-20f)));
    const real3 b = scale3(cross3(n, t), frame.sign);
    const real3 bent = madd3(n, m.z, madd3(b, m.y, scale3(t, m.x)));
    const mask usable = present & (across > 1e-4f) & (dot3(bent, bent) > 1e-8f);
    return choose(usable, normalize3(choose(usable, bent, n)), n);
}
#endif

#endif
