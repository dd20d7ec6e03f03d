#include "upload/common_features.h"

namespace onde {
namespace {

constexpr uint32_t bit(uint32_t index) {
    return 1u << index;
}

constexpr uint32_t ROOM_KINDS =
    bit(MATERIAL_DIFFUSE) | bit(MATERIAL_CONDUCTOR) | bit(MATERIAL_DIELECTRIC);
constexpr uint32_t ROOM_LOBES = bit(LOBE_DIFFUSE) | bit(LOBE_GLOSSY) | bit(LOBE_DIELECTRIC);
constexpr uint32_t GLTF_LOBES = bit(LOBE_DIFFUSE) | bit(LOBE_GLOSSY);

} // namespace

SceneFeatures model_features() {
    return with_all_materials(
        {.instances = true,
         .curved = true,
         .textures = true,
         .normal_maps = true,
         .environment = true,
         .texture_transforms = true,
         .nearest_filters = true,
         .alpha = true,
         .culling = true,
         .ground = true,
         .kinds = ROOM_KINDS | bit(MATERIAL_METALLIC_ROUGHNESS) | bit(MATERIAL_UNLIT),
         .lights = bit(LIGHT_TRIANGLE) | bit(LIGHT_POINT) | bit(LIGHT_SPOT) |
                   bit(LIGHT_DIRECTIONAL) | bit(LIGHT_ENVIRONMENT),
         .stack_size = 96});
}

std::vector<CommonFeatures> common_features() {
    const SceneFeatures room{.spheres = true,
                             .rough = true,
                             .albedos = true,
                             .lobes = ROOM_LOBES,
                             .kinds = ROOM_KINDS,
                             .lights = bit(LIGHT_TRIANGLE),
                             .stack_size = 64};
    const SceneFeatures shapes{.instances = true,
                               .shapes = true,
                               .environment = true,
                               .rough = true,
                               .albedos = true,
                               .lobes = ROOM_LOBES,
                               .kinds = ROOM_KINDS,
                               .lights = bit(LIGHT_DISK) | bit(LIGHT_ENVIRONMENT),
                               .stack_size = 64};
    const SceneFeatures textured{.curved = true,
                                 .textures = true,
                                 .normal_maps = true,
                                 .environment = true,
                                 .culling = true,
                                 .ground = true,
                                 .rough = true,
                                 .albedos = true,
                                 .lobes = GLTF_LOBES,
                                 .common_lobes = GLTF_LOBES,
                                 .kinds = bit(MATERIAL_METALLIC_ROUGHNESS),
                                 .lights = bit(LIGHT_ENVIRONMENT),
                                 .stack_size = 64};
    SceneFeatures large = textured;
    large.stack_size = 96; // of some ten thousand triangles
    SceneFeatures everything = with_all_materials(large);
    everything.instances = everything.spheres = true;
    everything.kinds = ALL_KINDS;
    everything.lights = bit(LIGHT_TRIANGLE) | bit(LIGHT_ENVIRONMENT);
    return {{"a closed room with spheres", room},
            {"analytic shapes", shapes},
            {"textured glTF, small", textured},
            {"textured glTF, large", large},
            {"textured glTF, beyond the cache", large, true},
            {"everything", everything},
            {"thumbnails of models", model_features()}};
}

} // namespace onde
