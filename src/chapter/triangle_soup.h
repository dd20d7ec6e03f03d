// All triangles of a scene in world space, for the laboratory.
#pragma once

#include "scene/scene.h"

namespace onde {

struct TriangleSoup {
    std::vector<glm::vec3> positions; ///< each belongs to a triangle
    std::vector<glm::uvec3> triangles;
};

/// Every mesh as its instances place it; spheres and other shapes are left out. Throws InputError
/// when nothing is left.
TriangleSoup scene_triangles(const Scene& scene);

} // namespace onde
