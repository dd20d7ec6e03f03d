// KHR_materials_pbrSpecularGlossiness, an older model of materials, as metallic-roughness.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

namespace onde::gltf {

/// The factors of either model; all linear, 0 to 1.
struct SpecularGlossiness {
    glm::vec3 diffuse{1.0f}, specular{1.0f};
    float glossiness = 1.0f;
};
struct MetallicRoughness {
    glm::vec3 base_color{1.0f};
    float metallic = 1.0f, roughness = 1.0f;
};

/// The metallic-roughness material that reflects as much: the conversion that Khronos published
/// beside the extension. Metals keep their reflectance, others get glTF's 4 %.
MetallicRoughness to_metallic_roughness(const SpecularGlossiness& source);

/// The two textures of the converted material, of the size of the larger image; either image may be
/// empty, which is white. `diffuse` and the colours of `specular` are sRGB.
struct ConvertedTextures {
    TexelImage base_color, metallic_roughness;
};
ConvertedTextures convert_textures(const SpecularGlossiness& factors, const TexelImage& diffuse,
                                   const TexelImage& specular);

} // namespace onde::gltf
