// Bilinear lookups in 8-bit textures.
#pragma once

#include "scene/scene.h"

#include <array>

namespace onde::reference {

/// The linear value of an 8-bit sRGB code (IEC 61966-2-1).
float srgb_to_linear(uint8_t code);

class TextureMap {
  public:
    TextureMap(const Texture& texture, const TexelImage& image);
    /// Linear rgb at uv (v downward, texel centres at half-integers), decoded before filtering.
    glm::vec3 sample(const glm::vec2& uv) const;
    /// Of all texels.
    glm::vec3 mean() const;

  private:
    glm::vec3 texel(int x, int y) const;

    TexelImage image_;
    Wrap wrap_u_, wrap_v_;
    std::array<float, 256> decode_;
};

} // namespace onde::reference
