// Lights of pbrt files.
#pragma once

#include "scene/exact_scene.h"
#include "scene/pbrt/spectrum.h"
#include "scene/sky.h"

namespace onde::pbrt {

/// Puts a LightSource into the scene, or among the lights of the sky.
void add_light(const std::string& kind, const Parameters& parameters, const glm::dmat4& to_world,
               ExactScene& scene, std::vector<SkyLight>& sky, const Sources& sources);

/// What an AreaLightSource makes of a surface.
struct AreaLight {
    glm::vec3 radiance{0.0f};
    bool two_sided = false;
};
AreaLight area_light_of(const std::string& kind, const Parameters& parameters,
                        const Sources& sources);

} // namespace onde::pbrt
