#include "scene/gltf/extensions.h"

#include <algorithm>
#include <array>

namespace onde::gltf {

static constexpr std::array EXTENSIONS{
    Extension{"EXT_lights_ies", Support::ignored, "the light shines without its profile"},
    Extension{"EXT_lights_image_based", Support::ignored},
    Extension{"EXT_mesh_gpu_instancing", Support::read},
    Extension{"EXT_meshopt_compression", Support::read, "all modes and filters"},
    Extension{"EXT_texture_webp", Support::mapped,
              "the first of its image and PNG or JPEG that can be read"},
    Extension{"KHR_animation_pointer", Support::ignored, "such channels do not move anything"},
    Extension{"KHR_draco_mesh_compression", Support::read},
    Extension{"KHR_lights_punctual", Support::read},
    Extension{"KHR_materials_anisotropy", Support::read, "of what is reflected"},
    Extension{"KHR_materials_clearcoat", Support::read},
    Extension{"KHR_materials_diffuse_transmission", Support::read},
    Extension{"KHR_materials_dispersion", Support::read},
    Extension{"KHR_materials_emissive_strength", Support::read},
    Extension{"KHR_materials_ior", Support::read},
    Extension{"KHR_materials_iridescence", Support::read},
    Extension{"KHR_materials_pbrSpecularGlossiness", Support::mapped,
              "converted to metallic-roughness, textures too"},
    Extension{"KHR_materials_sheen", Support::read},
    Extension{"KHR_materials_specular", Support::read},
    Extension{"KHR_materials_transmission", Support::read,
              "a sheet that does not bend light, but with a volume"},
    Extension{"KHR_materials_unlit", Support::read,
              "its colour shows to every ray; it is no light"},
    Extension{"KHR_materials_variants", Support::read, "those of `--variant`"},
    Extension{"KHR_materials_volume", Support::read, "any thickness above 0 is a solid"},
    Extension{"KHR_mesh_quantization", Support::read},
    Extension{"KHR_meshopt_compression", Support::read, "all modes and filters, version 1 too"},
    Extension{"KHR_node_visibility", Support::read},
    Extension{"KHR_texture_basisu", Support::mapped,
              "the first of its image and PNG or JPEG that can be read"},
    Extension{"KHR_texture_transform", Support::read, "its `texCoord` too"},
    Extension{"KHR_xmp_json_ld", Support::ignored},
    Extension{"MSFT_lod", Support::ignored, "the finest level is shown"},
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

std::string_view meaning_of(Support support) {
    switch (support) {
    case Support::read:
        return "read";
    case Support::mapped:
        return "mapped";
    case Support::ignored:
        return "ignored, with a note";
    case Support::none:
        break;
    }
    return "ignored, with a note; an error where the file requires it";
}

} // namespace onde::gltf
