// Materials of the older model of KHR_materials_pbrSpecularGlossiness.
#pragma once

#include "scene/gltf/textures.h"

namespace onde::gltf {

/// Converts them to metallic-roughness; textures are made anew where there is one of reflectances.
class OldMaterials {
  public:
    OldMaterials(File& file, Scene& scene, TextureLoader& textures)
        : file_(file), scene_(scene), textures_(textures) {}

    void apply(const JsonReader& source, const std::string& user, Material& material);
    /// Frees what no material uses any more.
    void release_textures();

  private:
    int32_t add(const Texture& like, TexelImage image, bool srgb);

    File& file_;
    Scene& scene_;
    TextureLoader& textures_;
    std::vector<int32_t> replaced_;
};

} // namespace onde::gltf
