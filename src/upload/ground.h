// The light that a scene's ground receives.
#pragma once

#include "scene/scene.h"

namespace onde {

/// One over the irradiance that light from infinity (environment and directional lights) gives to a
/// plane that faces +Y and that nothing shades, by colour; 0 where there is none, or no ground.
glm::vec3 ground_share(const Scene& scene);

} // namespace onde
