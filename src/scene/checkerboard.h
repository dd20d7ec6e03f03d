// A board of two colours as a texture, for formats that have one.
#pragma once

#include "scene/scene.h"

namespace onde {

/// Adds a texture of 2 by 2 texels, linear colours: `first` where the sum of the
/// coordinates' whole halves is even. Returns its index.
int32_t add_checkerboard(std::vector<Texture>& textures, const glm::vec3& first,
                         const glm::vec3& second, const UvTransform& transform);

} // namespace onde
