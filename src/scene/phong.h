// Between the chapter's materials and lights and the physical ones: every scene for every
// integrator.
#pragma once

#include "scene/scene.h"

namespace onde {

/// What Whitted makes of a material that is not phong: diffuse keeps its colour; a conductor
/// reflects, a smooth dielectric lets through, each by its base colour's largest component; a
/// metallic-roughness mix is diffuse as far as it is not metal, and the rest reflects. The rougher,
/// the wider the highlight: exponent 2 / alpha^2 - 2 (Walter et al. 2007), at most 1000.
Phong phong_of(const Material& material);

/// What the scene's file states of a material, else the above.
Phong phong_of(const Scene& scene, uint32_t material);

/// The chapter's intensity of a light, 0 where neither the file nor complete_scene() states one.
glm::vec3 point_intensity(const Scene& scene, uint32_t light);
glm::vec3 directional_intensity(const Scene& scene, uint32_t light);

/// What integrators that follow light make of a material: phong becomes a dielectric where more
/// than half goes through, a conductor where more than half is reflected, else diffuse. Others
/// stay.
Material path_material(const Scene& scene, uint32_t material);

/// Sets the measure that each light lacks: the chapter's intensity of a light is that with which a
/// diffuse surface that faces it from the scene's centre shows the same colour.
void complete_lights(Scene& scene);

} // namespace onde
