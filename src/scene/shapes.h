// Meshes of the analytic shapes that scene files name.
#pragma once

#include "scene/scene.h"

namespace onde {

/// Two triangles: corner, corner + edge1, corner + edge1 + edge2, corner + edge2, flat shaded, with
/// the front where edge1 x edge2 points; uv runs from (0, 1) at the corner, u along edge1, v up.
Mesh rectangle_mesh(const glm::vec3& corner, const glm::vec3& edge1, const glm::vec3& edge2,
                    uint32_t material);

/// Twelve triangles facing outward, centred on the origin, with uvs per face.
Mesh box_mesh(const glm::vec3& size, uint32_t material);

/// Applies an affine transform; triangles are turned over where it mirrors, so that fronts stay
/// fronts. Only for meshes without normals.
void bake(Mesh& mesh, const glm::mat4& transform);

} // namespace onde
