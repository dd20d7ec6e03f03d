// Tangent frames for normal maps where a file brings none.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace onde {

/// A corner of a triangle.
struct TangentCorner {
    glm::vec3 position, normal; ///< the normal is unit
    glm::vec2 uv;               ///< of the normal map, v downward
};

/// A tangent for each corner, unit, in w the sign of the bitangent as glTF has it: cross(normal,
/// tangent) * w points up in the picture. Three corners make a triangle. The frames are those of
/// MikkTSpace (M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008), by which normal
/// maps are baked: corners that share position, normal, texture coordinates and, by common edges,
/// the orientation of the map get the mean of their triangles' tangents, weighted by their angles.
std::vector<glm::vec4> corner_tangents(std::span<const TangentCorner> corners);

} // namespace onde
