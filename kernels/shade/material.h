// From a material record and a surface to BSDF and emission.
#ifndef ONDE_SHADE_MATERIAL_H
#define ONDE_SHADE_MATERIAL_H

#include "shade/bsdf.h"
#include "shade/surface.h"

// Reflectance at normal incidence of the dielectric half of glTF's mix (index 1.5).
#define DIELECTRIC_F0 0.04f

INLINE real3 material_emission(SceneView view, natural material, real2 uv) {
    const real3 factor = RECORD3(view.materials, material, MaterialRecord, emission);
#if ONDE_TEXTURES
    const natural texture =
        RECORD_NATURAL(view.materials, material, MaterialRecord, emission_texture);
    return mul3(factor, texture_color(view, texture, uv));
#else
    return factor;
#endif
}

// Whether light leaves the face that is seen.
INLINE mask material_emits(SceneView view, natural material, mask front) {
    return front | (RECORD_NATURAL(view.materials, material, MaterialRecord, two_sided) != 0u);
}

// The probability of the glossy lobe: by luminance of what each lobe reflects at this angle.
INLINE real glossy_probability(Bsdf b, real cosine) {
    const real glossy = luminance3(fresnel_schlick(b.f0, b.f90, cosine));
    const real diffuse = luminance3(b.diffuse) * (1.0f - glossy);
    const real p = glossy / max_real(glossy + diffuse, (real)(1e-6f));
    real bounded = clamp_real(p, 0.1f, 0.9f);
    bounded = choose(diffuse <= 0.0f, (real)(1.0f), bounded);
    return choose(b.f90 == 0.0f, (real)(0.0f), bounded);
}

// cosine: of the view direction and the shading normal, > 0.
INLINE Bsdf material_bsdf(SceneView view, Surface s, real cosine) {
    const natural kind = RECORD_NATURAL(view.materials, s.material, MaterialRecord, kind);
    real3 color = RECORD3(view.materials, s.material, MaterialRecord, base_color);
    real roughness = RECORD(view.materials, s.material, MaterialRecord, roughness);
    real metallic = RECORD(view.materials, s.material, MaterialRecord, metallic);
#if ONDE_TEXTURES
    color = mul3(color, texture_color(view,
                                      RECORD_NATURAL(view.materials, s.material, MaterialRecord,
                                                     base_color_texture),
                                      s.uv));
    const real3 packed = texture_data(
        view,
        RECORD_NATURAL(view.materials, s.material, MaterialRecord, metallic_roughness_texture),
        s.uv);
    roughness *= packed.y;
    metallic *= packed.z;
#endif
    const mask lambert = kind == MATERIAL_DIFFUSE;
    const real zero = (real)(0.0f), one = (real)(1.0f);
    metallic = choose(kind == MATERIAL_CONDUCTOR, one, metallic);
    metallic = choose(lambert, zero, metallic);
    Bsdf b;
    b.dielectric = kind == MATERIAL_DIELECTRIC;
    b.diffuse = choose(b.dielectric, color, scale3(color, 1.0f - metallic));
    b.f0 = choose(lambert, zero3(), mix3(splat3((real)(DIELECTRIC_F0)), color, metallic));
    b.f90 = choose(lambert, zero, one);
    b.alpha = roughness * roughness;
    b.glossy = glossy_probability(b, cosine);
    const real ior = RECORD(view.materials, s.material, MaterialRecord, ior);
    b.eta = choose(s.front, ior, 1.0f / ior);
    return b;
}

#endif
