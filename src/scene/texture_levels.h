// Coarser levels of pictures, for textures whose filter asks for them.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace onde {

bool has_mip_textures(const Scene& scene);

/// By texture, whether the picture of its own is to have coarser levels.
std::vector<bool> pictures_with_levels(const Scene& scene);

/// A side of the next level, half as long.
constexpr uint32_t coarser_side(uint32_t side) {
    return side > 1 ? side / 2 : 1;
}

/// The texels of a picture and of all its levels, down to one texel.
uint64_t texels_of_levels(uint32_t width, uint32_t height);

} // namespace onde
