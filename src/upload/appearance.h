// Materials and textures as device records.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

#include <cstdint>
#include <vector>

namespace onde {

/// The lobes of kernels/shared/scene.h that a material has, as bits.
uint32_t lobes_of(const Material& material);

/// What a material asks of kernels; see SCENE_FEATURES.
struct MaterialFeatures {
    bool rough;       ///< it reflects or refracts by microfacets
    bool rough_glass; ///< and is solid glass
    bool albedos;     ///< it asks what its microfacets reflect in all
    bool beckmann;    ///< and these are distributed as Beckmann's
    bool index;       ///< its coat's is not 1.5
    bool specular;    ///< it reflects less, or in colour
    bool iridescence;
    bool edges; ///< it is a metal whose edges have a tint
    bool inner; ///< its coat sends light back to its body
    bool anisotropy;
    bool dispersion;
    bool transmission; ///< its body is clear in part
    bool absorption;
    bool pane;   ///< light goes straight through it, as it is thin and may be smooth
    bool unbent; ///< likewise, though it is solid: light that no other way finds
};
MaterialFeatures features_of(const Material& material);

struct PackedMaterials {
    std::vector<MaterialRecord> records;
    std::vector<MediumRecord> media;    ///< empty where light meets nothing on its way
    std::vector<GridRecord> grids;      ///< of media
    std::vector<uint32_t> albedos;      ///< tables of shared/albedo.h
    std::vector<SpectrumKnot> spectrum; ///< empty where nothing disperses light
};
PackedMaterials pack_materials(const Scene& scene);

/// The sets of texture coordinates that the scene's textures use, ascending; at least one. They are
/// packed in this order.
std::vector<uint32_t> used_uv_sets(const Scene& scene);

struct PackedTextures {
    std::vector<TextureRecord> records;
    std::vector<uint32_t>
        texels; ///< RGBA8, red lowest; of 16 bits the higher bytes, then the lower
};
/// Throws InputError beyond 2^32 texels.
PackedTextures pack_textures(const Scene& scene);

/// Linear values of the 256 sRGB codes (IEC 61966-2-1).
std::vector<float> srgb_table();

} // namespace onde
