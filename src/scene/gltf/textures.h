// Textures and images of glTF (section 3.8).
#pragma once

#include "scene/gltf/scene.h"

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace onde::gltf {

/// Decodes each texture when it is first used, once for each way of using it.
class TextureLoader {
  public:
    TextureLoader(File& file, Scene& scene) : file_(file), scene_(scene) {}

    /// The scene's index of the texture that `key` of a material's part names, or NO_TEXTURE where
    /// there is none or we can't use it.
    int32_t load(const std::optional<JsonReader>& part, std::string_view key, bool srgb,
                 const std::string& user);

    bool is_shown = true; ///< whether the material in work is; else it goes without textures

  private:
    std::optional<std::span<const uint8_t>> encoded(uint32_t index, const std::string& user);
    std::optional<TexelImage> decode(uint32_t index, const std::string& user);
    uint32_t first_of_file(uint32_t index, const std::string& user);
    std::optional<TexelImage> decode_any(const TextureSource& texture, const std::string& user);

    File& file_;
    Scene& scene_;
    std::map<uint32_t, std::vector<int32_t>> loaded_;   ///< the textures of an image
    std::map<std::string_view, uint32_t> first_of_uri_; ///< images
    std::map<std::pair<const uint8_t*, size_t>, uint32_t> first_of_bytes_;
    std::map<uint32_t, std::optional<std::span<const uint8_t>>> encoded_; ///< by image
    std::set<uint32_t> missing_;                                          ///< images
};

} // namespace onde::gltf
