// What the nodes of a glTF file place stays in double precision until all is known, then becomes
// floats that are counted from the scene's origin.
#pragma once

#include "scene/gltf/file.h"
#include "scene/scene.h"

#include <optional>
#include <span>
#include <vector>

namespace onde::gltf {

/// A mesh of the scene, or a camera or light of the file.
struct Placement {
    uint32_t index = 0, node = 0;
    glm::dmat4 to_world{1.0};
    uint32_t top = 0; ///< the topmost node above that
};

struct Placements {
    std::vector<Placement> meshes, cameras, lights;
};

/// Adds instances, cameras and lights to the scene and chooses its origin. The positions of its
/// meshes are counted from `mesh_origins`. Throws InputError for cameras that can't be.
void place(File& file, const Placements& placements, std::vector<glm::dvec3> mesh_origins,
           Scene& scene);

/// Whether a transform flattens space and has no inverse.
bool is_flat(const glm::mat4& m);

/// The transform, if flat, with a thickness of 1e-4 of its size along the normal of its plane, so
/// that it has an inverse. Nothing where it leaves no area, as exporters hide an object.
std::optional<glm::dmat4> with_thickness(const glm::dmat4& m);

} // namespace onde::gltf
