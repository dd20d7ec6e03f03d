// How much of a surface is there: by its material's alpha, times that of its base colour texture
// and of its vertices.
#ifndef ONDE_SHADE_OPACITY_H
#define ONDE_SHADE_OPACITY_H

#include "shade/surface.h"

// 1 where nothing passes, 0 where all does.
INLINE real material_opacity(SceneView view, natural material, UvSets uvs, real vertex_alpha) {
#if ONDE_ALPHA
    const natural mode = RECORD_NATURAL(view.materials, material, MaterialRecord, alpha_mode);
    const mask transparent = mode != ALPHA_OPAQUE;
    const real one = (real)(1.0f);
    if (!mask_bits(transparent)) return one;
    real alpha = RECORD(view.materials, material, MaterialRecord, alpha) * vertex_alpha;
    #if ONDE_TEXTURES
    const natural texture = material_texture(view, material, TEXTURE_BASE_COLOR);
    alpha *= texture_alpha(view, choose(transparent, texture, (natural)(NO_INDEX)), uvs);
    #endif
    const real cutoff = RECORD(view.materials, material, MaterialRecord, alpha_cutoff);
    const real masked = choose(alpha < cutoff, (real)(0.0f), one);
    alpha = choose(mode == ALPHA_MASK, masked, clamp_real(alpha, 0.0f, 1.0f));
    return choose(transparent, alpha, one);
#else
    return (real)(1.0f);
#endif
}

#endif
