#include "scene/material.h"

#include <cmath>

namespace onde {

glm::vec2 UvTransform::operator()(glm::vec2 uv) const {
    const glm::vec2 scaled = uv * scale;
    const float c = std::cos(rotation), s = std::sin(rotation);
    return glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x) + offset;
}

const TexelImage& image_of(const std::vector<Texture>& textures, const Texture& texture) {
    return texture.same_image_as == NO_TEXTURE ? texture.image
                                               : textures[size_t(texture.same_image_as)].image;
}

} // namespace onde
