// Light from infinity as other renderers' files state it: pictures of several shapes, turned any
// way, some at once. They become the one environment of a scene.
#pragma once

#include "scene/load_context.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace onde {

/// How a picture covers the sphere, in the space of its light.
enum class SkyShape {
    uniform,         ///< no picture
    octahedral,      ///< equal areas, +Z in the middle of a square (Clarberg 2008)
    equirectangular, ///< as Environment::map
};

/// The place of a direction on an octahedral picture, from 0 to 1.
glm::dvec2 octahedral_uv(const glm::dvec3& direction);

/// The pixel of a picture of 3 channels at such a place.
glm::vec3 pixel_at(const Image& picture, const glm::dvec2& uv);

/// What turns directions without changing them otherwise, or the identity of a singular matrix.
glm::dmat3 turn_of(const glm::dmat3& m);

/// Some of the light of a sky.
struct SkyLight {
    glm::vec3 radiance{1.0f}; ///< multiplies the picture
    SkyShape shape = SkyShape::uniform;
    Image picture{};                ///< of 3 channels; none if uniform
    glm::dmat3 light_to_world{1.0}; ///< may mirror; what else it does is not kept
};

/// The sum of the lights as an environment: a map of its own pixels where a picture stands upright,
/// else one drawn anew, which is spent from what the load of the file `name` may use.
Environment environment_of(std::vector<SkyLight> lights, LoadContext& context,
                           const std::string& name);

} // namespace onde
