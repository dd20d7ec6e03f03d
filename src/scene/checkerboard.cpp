#include "scene/checkerboard.h"

#include "scene/references.h"

#include <algorithm>

namespace onde {

int32_t add_checkerboard(std::vector<Texture>& textures, const glm::vec3& first,
                         const glm::vec3& second, const UvTransform& transform) {
    constexpr size_t TEXELS = 4;
    TexelImage image;
    image.width = image.height = 2;
    for (size_t i = 0; i < TEXELS; ++i) {
        const glm::vec3& texel = i == 0 || i == 3 ? first : second;
        for (glm::length_t c = 0; c < 3; ++c) image.floats.push_back(std::max(texel[c], 0.0f));
        image.floats.push_back(1.0f);
    }
    const TextureUse use{.filter = TextureFilter::nearest, .transform = transform};
    return add_texture(textures, "checkerboard", std::move(image), use);
}

} // namespace onde
