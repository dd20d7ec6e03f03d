// From a material record and a surface to BSDF and emission.
#ifndef ONDE_SHADE_MATERIAL_H
#define ONDE_SHADE_MATERIAL_H

#include "shade/bsdf.h"
#include "shade/opacity.h"

INLINE real3 material_emission(SceneView view, natural material, UvSets uv) {
    const real3 factor = RECORD3(view.materials, material, MaterialRecord, emission);
#if ONDE_TEXTURES
    const natural texture = material_texture(view, material, TEXTURE_EMISSION);
    return mul3(factor, texture_color(view, texture, uv));
#else
    return factor;
#endif
}

// Whether light leaves the face that is seen.
INLINE mask material_emits(SceneView view, natural material, mask front) {
    return front | (RECORD_NATURAL(view.materials, material, MaterialRecord, two_sided) != 0u);
}

// The group of lights that what it emits belongs to.
INLINE natural material_group(SceneView view, natural material) {
    return RECORD_NATURAL(view.materials, material, MaterialRecord, group);
}

// The base colour at a surface.
INLINE real3 material_color(SceneView view, Surface s) {
    real3 color = RECORD3(view.materials, s.material, MaterialRecord, base_color);
#if ONDE_TEXTURES
    const natural texture = material_texture(view, s.material, TEXTURE_BASE_COLOR);
    color = mul3(color, texture_color(view, texture, s.uv));
#endif
#if ONDE_VERTEX_COLORS
    color = mul3(color, s.tint);
#endif
    return color;
}

// Whether some material of the scene is unlit, and which lanes' are.
#define HAS_UNLIT (ONDE_KINDS >> MATERIAL_UNLIT & 1u)
INLINE mask is_unlit(SceneView view, natural material) {
    return RECORD_NATURAL(view.materials, material, MaterialRecord, kind) == MATERIAL_UNLIT;
}

// The material at a surface. cosine: of the view direction and the shading normal, > 0.
INLINE MaterialPoint material_point(SceneView view, Surface s, real cosine) {
    MaterialPoint m;
    m.material = s.material;
    m.uv = s.uv;
    m.kind = RECORD_NATURAL(view.materials, s.material, MaterialRecord, kind);
    m.color = material_color(view, s);
    real roughness = RECORD(view.materials, s.material, MaterialRecord, roughness);
    m.metallic = RECORD(view.materials, s.material, MaterialRecord, metallic);
    m.front = s.front;
    m.cosine = cosine;
#if ONDE_TEXTURES
    const natural rough_metal = material_texture(view, s.material, TEXTURE_METALLIC_ROUGHNESS);
    const real3 packed = texture_data(view, rough_metal, s.uv);
    roughness *= packed.y;
    m.metallic *= packed.z;
#endif
    m.alpha = roughness * roughness;
#if ONDE_ALBEDOS
    m.row = albedo_row((natural)(0u), m.alpha);
    m.albedo = reflection_albedo(view.albedos, m.row, m.cosine);
#endif
#if ONDE_TRANSMISSION
    m.transmission = RECORD(view.materials, s.material, MaterialRecord, transmission);
    #if ONDE_TEXTURES
    const natural clear = material_texture(view, s.material, TEXTURE_TRANSMISSION);
    m.transmission *= texture_data(view, clear, s.uv).x;
    #endif
#endif
    return m;
}
INLINE Bsdf material_bsdf(SceneView view, Surface s, real cosine) {
    return bsdf_load(view, material_point(view, s, cosine));
}

#endif
