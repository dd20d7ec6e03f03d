// Materials as device records.
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

} // namespace onde
