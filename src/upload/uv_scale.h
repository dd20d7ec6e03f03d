// How much of its texture coordinates a triangle shows per unit of length.
#pragma once

#include <glm/glm.hpp>

namespace onde {

/// Along the direction in which they grow least: the smaller singular value of their derivative on
/// the triangle with those corners. 0 where it has no area, on it or among the coordinates.
float uv_scale(const glm::vec3 (&corners)[3], const glm::vec2 (&uvs)[3]);

} // namespace onde
