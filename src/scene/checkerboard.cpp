#include "scene/checkerboard.h"

#include "scene/references.h"

#include <algorithm>

namespace onde {

int32_t add_checkerboard(std::vector<Texture>& textures, const glm::vec3& first,
                         const glm::vec3& second, const UvTransform& transform) {
    constexpr size_t TEXELS = 4;
    ByteImage image;
    image.width = image.height = 2;
    image.from_floats = true;
    for (size_t i = 0; i < TEXELS; ++i) {
        const glm::vec4 texel(i == 0 || i == 3 ? first : second, 1.0f);
        for (glm::length_t c = 0; c < 4; ++c) {
            const auto wide = uint32_t(std::clamp(texel[c], 0.0f, 1.0f) * 65535.0f + 0.5f);
            image.rgba.push_back(uint8_t(wide >> 8));
            image.low.push_back(uint8_t(wide));
        }
    }
    const TextureUse use{.filter = TextureFilter::nearest, .transform = transform};
    return add_texture(textures, "checkerboard", std::move(image), use);
}

} // namespace onde
