// What kernels are compiled for.
#pragma once

#include "accel/bvh.h"
#include "shared/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace onde {

inline constexpr uint32_t ALL_KINDS = (1u << MATERIAL_KIND_COUNT) - 1;
inline constexpr uint32_t ALL_LOBES = (1u << LOBE_COUNT) - 1;
inline constexpr uint32_t ALL_LIGHTS = (1u << LIGHT_TYPE_COUNT) - 1;

/// FEATURE(Type, name, initial, NAME of the kernels' ONDE_NAME, how kernels of two scenes have it):
/// either: as bits of both; shared: what both have; larger: the larger number; data: as it lies in
/// memory, so that there are no kernels for two scenes that differ in it.
#define SCENE_FEATURES(FEATURE)                                                                    \
    FEATURE(bool, instances, false, INSTANCES, either)                                             \
    FEATURE(bool, spheres, false, SPHERES, either)                                                 \
    FEATURE(bool, shapes, false, SHAPES, either)                                                   \
    FEATURE(bool, curved, false, CURVED, either) /* triangles have normals of their own */         \
    FEATURE(bool, textures, false, TEXTURES, either)                                               \
    FEATURE(bool, normal_maps, false, NORMAL_MAPS, either)                                         \
    FEATURE(bool, environment, false, ENVIRONMENT, either)                                         \
    FEATURE(uint32_t, uv_sets, 1, UV_SETS, data) /* of texture coordinates */                      \
    FEATURE(bool, texture_transforms, false, TEXTURE_TRANSFORMS, either)                           \
    FEATURE(bool, nearest_filters, false, NEAREST_FILTERS, either)                                 \
    FEATURE(bool, wide_textures, false, WIDE_TEXTURES, either) /* some have 16-bit samples */      \
    FEATURE(bool, vertex_colors, false, VERTEX_COLORS, data)                                       \
    FEATURE(bool, alpha, false, ALPHA, either)     /* some surface lets rays pass */               \
    FEATURE(bool, culling, false, CULLING, either) /* cameras see through the back of some */      \
    FEATURE(bool, ground, false, GROUND, either)   /* a plane takes the scene's shadow */          \
    FEATURE(bool, rough, false, ROUGH, either)     /* some surface has microfacets */              \
    FEATURE(bool, rough_glass, false, ROUGH_GLASS, either) /* some solid glass does */             \
    FEATURE(bool, beckmann, false, BECKMANN, either)       /* some microfacets are Beckmann's */   \
    FEATURE(bool, albedos, false, ALBEDOS, either)   /* some asks what they reflect in all */      \
    FEATURE(bool, indices, false, INDICES, either)   /* of coats other than 1.5 */                 \
    FEATURE(bool, specular, false, SPECULAR, either) /* some coat reflects less, or in colour */   \
    FEATURE(bool, iridescence, false, IRIDESCENCE, either)   /* some coat is a thin film */        \
    FEATURE(bool, anisotropy, false, ANISOTROPY, either)     /* some microfacets have a grain */   \
    FEATURE(bool, dispersion, false, DISPERSION, either)     /* some solid bends by colour */      \
    FEATURE(bool, edges, false, EDGES, either)               /* of some metal have a tint */       \
    FEATURE(bool, inner, false, INNER, either)               /* some is plastic */                 \
    FEATURE(bool, blends, false, BLENDS, either)             /* of two materials */                \
    FEATURE(bool, transmission, false, TRANSMISSION, either) /* some coat's body is clear */       \
    FEATURE(bool, absorption, false, ABSORPTION, either)     /* in some solid */                   \
    FEATURE(bool, media, false, MEDIA, data)     /* light is scattered on its way, or absorbed */  \
    FEATURE(bool, glow, false, GLOW, either)     /* some of them glow */                           \
    FEATURE(bool, grids, false, GRIDS, either)   /* some are not as dense everywhere */            \
    FEATURE(bool, panes, false, PANES, either)   /* light goes straight through some thin wall */  \
    FEATURE(bool, unbent, false, UNBENT, either) /* or through solid glass, for want of others */  \
    FEATURE(uint32_t, lobes, 0, LOBES, either)   /* bits by LOBE_..., of some material */          \
    FEATURE(uint32_t, common_lobes, 0, COMMON_LOBES, shared) /* and of all */                      \
    FEATURE(uint32_t, kinds, 0, KINDS, either)               /* bits by MATERIAL_... */            \
    FEATURE(uint32_t, lights, 0, LIGHTS, either)             /* bits by LIGHT_... */               \
    FEATURE(bool, motion, false, MOTION, data)               /* the next frame is known */         \
    FEATURE(bool, light_tree, false, LIGHT_TREE, data)                                             \
    FEATURE(uint32_t, stack_size, 1, STACK_SIZE, larger)                                           \
    FEATURE(bool, watertight, false, WATERTIGHT, data)

/// What a scene needs of the kernels; the rest is not compiled.
struct SceneFeatures {
#define ONDE_FEATURE(Type, name, initial, NAME, join) Type name = initial;
    SCENE_FEATURES(ONDE_FEATURE)
#undef ONDE_FEATURE
    BvhLayout layout = BvhLayout::wide;

    /// As definitions for the kernels: "ONDE_TEXTURES=1", ...
    std::vector<std::string> defines() const;
};

/// The same, and all that materials may ask for, but for kinds.
SceneFeatures with_all_materials(SceneFeatures features);

/// What covers a scene that has `own`, and others that have `more`, as far as one program can.
SceneFeatures joined(SceneFeatures own, const SceneFeatures& more);

} // namespace onde
