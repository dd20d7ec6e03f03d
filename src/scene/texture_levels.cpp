#include "scene/texture_levels.h"

#include <algorithm>

namespace onde {

bool has_mip_textures(const Scene& scene) {
    return std::ranges::any_of(scene.textures, [](const Texture& texture) {
        return texture.filter == TextureFilter::mip;
    });
}

std::vector<bool> pictures_with_levels(const Scene& scene) {
    std::vector<bool> with(scene.textures.size());
    for (size_t i = 0; i < scene.textures.size(); i++) {
        const int32_t same = scene.textures[i].same_image_as;
        if (scene.textures[i].filter == TextureFilter::mip)
            with[same == NO_TEXTURE ? i : size_t(same)] = true;
    }
    return with;
}

uint64_t texels_of_levels(uint32_t width, uint32_t height) {
    uint64_t texels = uint64_t(width) * height;
    while (std::max(width, height) > 1) {
        width = coarser_side(width);
        height = coarser_side(height);
        texels += uint64_t(width) * height;
    }
    return texels;
}

} // namespace onde
