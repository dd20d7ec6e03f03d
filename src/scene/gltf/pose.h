// Posed geometry of glTF: morph targets (section 3.7.2.2) and skins (section 3.7.3).
#pragma once

#include "scene/gltf/file.h"
#include "scene/mesh_parts.h"

namespace onde::gltf {

/// What moves the vertices of a mesh.
struct Pose {
    std::vector<double> weights;      ///< of the morph targets; missing ones are 0
    std::vector<glm::dmat4> joints{}; ///< bind pose to world, for skinned meshes
};

/// Moves the positions and normals of a part. Throws InputError for indices and sizes that lie.
void pose_part(File& file, const Primitive& primitive, const Pose& pose, const std::string& user,
               MeshPart& part);

/// Where each node stands in the world, whether or not it is in the scene that is shown. Throws
/// InputError for a node that is reached twice.
class NodeWorlds {
  public:
    explicit NodeWorlds(const File& file);
    /// Throws InputError for a node that is part of a cycle.
    const glm::dmat4& of(uint32_t node, const std::string& user) const;

  private:
    const File& file_;
    std::vector<glm::dmat4> worlds_;
    std::vector<bool> known_;
};

/// The joints' matrices of a skin: from the bind pose to the world.
std::vector<glm::dmat4> joint_matrices(const File& file, uint32_t skin, const NodeWorlds& worlds);

/// The node's own transform. Throws InputError for one that is not affine.
glm::dmat4 local_transform(const File& file, const Node& node, const std::string& user);

} // namespace onde::gltf
