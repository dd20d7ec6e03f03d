#include "scene/gltf_extensions.h"

#include <algorithm>
#include <array>

namespace onde::gltf {

static constexpr std::array EXTENSIONS{
    Extension{"EXT_mesh_gpu_instancing", Support::read},
    Extension{"EXT_meshopt_compression", Support::read},
    Extension{"KHR_animation_pointer", Support::ignored},
    Extension{"KHR_draco_mesh_compression", Support::read},
    Extension{"KHR_lights_punctual", Support::read},
    Extension{"KHR_materials_emissive_strength", Support::read},
    Extension{"KHR_materials_ior", Support::read},
    Extension{"KHR_materials_pbrSpecularGlossiness", Support::mapped},
    Extension{"KHR_materials_transmission", Support::mapped},
    Extension{"KHR_materials_variants", Support::read},
    Extension{"KHR_mesh_quantization", Support::read},
    Extension{"KHR_meshopt_compression", Support::read},
    Extension{"KHR_texture_transform", Support::none},
    Extension{"KHR_xmp_json_ld", Support::ignored},
};

std::span<const Extension> known_extensions() {
    return EXTENSIONS;
}

Support support_of(std::string_view name) {
    const auto found = std::ranges::find(EXTENSIONS, name, &Extension::name);
    if (found != EXTENSIONS.end()) return found->support;
    // Materials are refined by them: without, the base material shows.
    return name.starts_with("KHR_materials_") ? Support::ignored : Support::none;
}

} // namespace onde::gltf
