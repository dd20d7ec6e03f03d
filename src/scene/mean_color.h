// What a texture is on the whole.
#pragma once

#include "scene/scene.h"

namespace onde {

/// The mean of all texels, linear.
glm::vec3 mean_color(const Scene& scene, int32_t texture);

} // namespace onde
