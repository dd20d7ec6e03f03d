// What a clear coat does to the colour of a diffuse body under it.
#pragma once

#include <glm/glm.hpp>

namespace onde {

/// The share of diffuse light from within a dielectric of that index that its smooth surface sends
/// back, by Fresnel's equations.
double internal_reflectance(double index);

/// The albedo that a body of this one seems to have under a smooth coat of that index: light that
/// the coat sends back meets the body again (Saunderson 1942, without the light that the coat
/// reflects at once). Per channel, from 0 to 1.
glm::vec3 coated_albedo(const glm::vec3& albedo, double index);

} // namespace onde
