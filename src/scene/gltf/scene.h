// The steps from a parsed glTF file to a Scene, in the order in which gltf.cpp takes them.
#pragma once

#include "scene/gltf/pose.h"
#include "scene/scene.h"

#include <map>
#include <tuple>

namespace onde::gltf {

/// Appends one Material for each of the file's and then the default one, with the textures used.
void add_materials(File& file, Scene& scene);

/// Makes meshes when nodes ask for them, after the materials. Equal ones become one.
class MeshLoader {
  public:
    MeshLoader(File& file, Scene& scene);

    /// The scene's index of a mesh of the file in that pose; nothing if it has no triangles.
    /// `skin` tells the poses of one mesh's skins apart.
    Index load(uint32_t mesh, const Pose& pose, Index skin, const std::string& user);

    /// From which the positions of the scene's meshes are counted.
    const std::vector<glm::dvec3>& origins() const { return origins_; }

  private:
    using Key = std::tuple<uint32_t, std::vector<double>, Index>;

    Index build(const MeshSource& source, uint32_t mesh, const Pose& pose);

    File& file_;
    Scene& scene_;
    Index variant_;
    std::map<Key, Index> loaded_;
    std::map<std::string, Index> equal_; ///< by what their primitives say
    std::vector<glm::dvec3> origins_;
    size_t vertices_ = 0;
};

/// Traverses the scene that is asked for, or the default one: instances, cameras and lights.
void add_nodes(File& file, Scene& scene);

} // namespace onde::gltf
