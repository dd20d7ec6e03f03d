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

// Whether some material of the scene is unlit, and which lanes' are.
#define HAS_UNLIT (ONDE_KINDS >> MATERIAL_UNLIT & 1u)
INLINE mask is_unlit(SceneView view, natural material) {
    return RECORD_NATURAL(view.materials, material, MaterialRecord, kind) == MATERIAL_UNLIT;
}

#if ONDE_TEXTURES
// What is unlit is as bright as its texture.
INLINE real3 base_color_texel(SceneView view, Surface s, natural texture) {
    if (!(HAS_UNLIT && ONDE_FLOAT_TEXTURES)) return texture_tint(view, texture, s.uv);
    const mask shown = is_unlit(view, s.material);
    const real3 color = texture_color(view, texture, s.uv);
    return choose(shown, color, at_most_one(color));
}
#endif

// The base colour at a surface.
INLINE real3 material_color(SceneView view, Surface s) {
    real3 color = RECORD3(view.materials, s.material, MaterialRecord, base_color);
#if ONDE_TEXTURES
    const natural texture = material_texture(view, s.material, TEXTURE_BASE_COLOR);
    color = mul3(color, base_color_texel(view, s, texture));
#endif
#if ONDE_VERTEX_COLORS
    color = mul3(color, s.tint);
#endif
    return color;
}

#if ONDE_TEXTURES
    #define MATERIAL_DATA(view, s, NAME)                                                           \
        texture_data(view, material_texture(view, (s).material, TEXTURE_##NAME), (s).uv)
    #define MATERIAL_TINT(view, s, NAME)                                                           \
        texture_tint(view, material_texture(view, (s).material, TEXTURE_##NAME), (s).uv)
    #define MATERIAL_ALPHA(view, s, NAME)                                                          \
        texture_alpha(view, material_texture(view, (s).material, TEXTURE_##NAME), (s).uv)
#else
    #define MATERIAL_DATA(view, s, NAME) splat3((real)(1.0f))
    #define MATERIAL_TINT(view, s, NAME) splat3((real)(1.0f))
    #define MATERIAL_ALPHA(view, s, NAME) (real)(1.0f)
#endif
#define MATERIAL_NUMBER(view, s, name) RECORD(view.materials, (s).material, MaterialRecord, name)
#define MATERIAL_COLOR(view, s, name) RECORD3(view.materials, (s).material, MaterialRecord, name)

// How the dielectric half reflects (KHR_materials_ior, KHR_materials_specular).
INLINE MaterialPoint with_reflectance(SceneView view, Surface s, MaterialPoint m) {
    real f0 = (real)(DIELECTRIC_F0);
#if ONDE_INDICES
    const real ior = MATERIAL_NUMBER(view, s, ior);
    f0 = square((ior - 1.0f) / (ior + 1.0f));
#endif
    m.f0 = splat3(f0);
    m.f90 = (real)(1.0f);
#if ONDE_SPECULAR
    m.f90 = MATERIAL_NUMBER(view, s, specular) * MATERIAL_ALPHA(view, s, SPECULAR);
    const real3 color =
        mul3(MATERIAL_COLOR(view, s, specular_color), MATERIAL_TINT(view, s, SPECULAR_COLOR));
    m.f0 = make3(min_real(f0 * color.x, (real)(1.0f)) * m.f90,
                 min_real(f0 * color.y, (real)(1.0f)) * m.f90,
                 min_real(f0 * color.z, (real)(1.0f)) * m.f90);
#endif
#if ONDE_IRIDESCENCE
    m.iridescence = MATERIAL_NUMBER(view, s, iridescence) * MATERIAL_DATA(view, s, IRIDESCENCE).x;
    const real least = MATERIAL_NUMBER(view, s, iridescence_thickness_minimum);
    const real most = MATERIAL_NUMBER(view, s, iridescence_thickness);
    m.film.ior = MATERIAL_NUMBER(view, s, iridescence_ior);
    const real share = MATERIAL_DATA(view, s, IRIDESCENCE_THICKNESS).y;
    m.film.thickness = fma(share, most, least * (1.0f - share));
    const real there = clamp_real(m.film.thickness * (1.0f / 0.03f), 0.0f, 1.0f);
    m.iridescence *= there * there * (3.0f - 2.0f * there); // a film of nothing is none
#endif
    return m;
}

// What lets light through the body.
INLINE MaterialPoint with_transmission(SceneView view, Surface s, MaterialPoint m) {
#if ONDE_TRANSMISSION
    m.transmission =
        MATERIAL_NUMBER(view, s, transmission) * MATERIAL_DATA(view, s, TRANSMISSION).x;
#endif
    m.behind = (real)(0.0f);
    if (HAS_LOBE(BEHIND)) {
        m.behind = MATERIAL_NUMBER(view, s, diffuse_transmission) *
                   MATERIAL_ALPHA(view, s, DIFFUSE_TRANSMISSION);
        m.behind_color = mul3(MATERIAL_COLOR(view, s, diffuse_transmission_color),
                              MATERIAL_TINT(view, s, DIFFUSE_TRANSMISSION_COLOR));
    }
    return m;
}

INLINE mask is_thin(SceneView view, MaterialPoint m) {
    if (!HAS_LOBE(THIN)) return (mask)(0);
    return (RECORD_NATURAL(view.materials, m.material, MaterialRecord, lobes) >> LOBE_THIN & 1u) !=
           0u;
}

// What lies on top.
INLINE MaterialPoint with_layers(SceneView view, Surface s, MaterialPoint m) {
    if (HAS_LOBE(COAT)) {
        m.clearcoat = MATERIAL_NUMBER(view, s, clearcoat) * MATERIAL_DATA(view, s, CLEARCOAT).x;
        m.coat_alpha = square(MATERIAL_NUMBER(view, s, clearcoat_roughness) *
                              MATERIAL_DATA(view, s, CLEARCOAT_ROUGHNESS).y);
    }
    if (HAS_LOBE(SHEEN)) {
        m.sheen_color =
            mul3(MATERIAL_COLOR(view, s, sheen_color), MATERIAL_TINT(view, s, SHEEN_COLOR));
        const real roughness =
            MATERIAL_NUMBER(view, s, sheen_roughness) * MATERIAL_ALPHA(view, s, SHEEN_ROUGHNESS);
        m.sheen_alpha = square(max_real(roughness, (real)(LEAST_SHEEN_ROUGHNESS)));
    }
    return m;
}

// The material at a surface. wo: the view direction in the shading normal's basis, above.
INLINE MaterialPoint material_point(SceneView view, Surface s, real3 wo) {
    MaterialPoint m;
    m.material = s.material;
    m.uv = s.uv;
    m.kind = RECORD_NATURAL(view.materials, s.material, MaterialRecord, kind);
    m.color = material_color(view, s);
    m.front = s.front;
#if ONDE_DISPERSION
    m.bend = s.bend;
#endif
    m.wo = wo;
    m.cosine = wo.z;
    const real3 packed = MATERIAL_DATA(view, s, METALLIC_ROUGHNESS);
    m.metallic = MATERIAL_NUMBER(view, s, metallic);
    real roughness = MATERIAL_NUMBER(view, s, roughness);
#if ONDE_TEXTURES
    roughness *= packed.y;
    m.metallic *= packed.z;
#endif
    m.alpha = roughness * roughness;
#if ONDE_INNER
    m.plastic = is_of_kind(m, MATERIAL_METALLIC_ROUGHNESS) &
                (MATERIAL_NUMBER(view, s, inner_reflection) >= 0.0f);
    m.exact = choose(m.plastic, max_real(fma(m.alpha, (real)(-10.0f), (real)(1.0f)), (real)(0.0f)),
                     (real)(0.0f));
    m.ior = MATERIAL_NUMBER(view, s, ior);
#endif
    m.beckmann = (mask)(0);
#if ONDE_BECKMANN
    m.beckmann = RECORD_NATURAL(view.materials, s.material, MaterialRecord, beckmann) != 0u;
#endif
#if ONDE_ANISOTROPY
    m.roughness = roughness;
    m.anisotropy = MATERIAL_NUMBER(view, s, anisotropy) * MATERIAL_DATA(view, s, ANISOTROPY).z;
    const mask grained = m.anisotropy > 0.0f;
    const real across = choose(grained, max_real(m.alpha, (real)(SMOOTH_ALPHA)), m.alpha);
    m.grain = make2(fma(1.0f - across, square(m.anisotropy), across), across);
#endif
    m.albedo = microfacet_albedo(view, m, wo, is_glossy(m) | is_thin(view, m));
    m.coat_normal = make3((real)(0.0f), (real)(0.0f), (real)(1.0f));
    m = with_reflectance(view, s, m);
    return with_layers(view, s, with_transmission(view, s, m));
}

// The BSDF at a surface, whose shading normal is that of the basis.
INLINE Bsdf material_bsdf(SceneView view, Surface s, Basis basis, real3 wo) {
    MaterialPoint m = material_point(view, s, wo);
#if ONDE_NORMAL_MAPS
    if (HAS_LOBE(COAT)) {
        const real3 coat = to_local(basis, s.coat_normal);
        m.coat_normal = choose(coat.z > 0.0f, coat, m.coat_normal);
    }
#endif
    return bsdf_load(view, m);
}

#endif
