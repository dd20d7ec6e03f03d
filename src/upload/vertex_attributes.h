// What vertices have beside their records: further texture coordinates, colours, tangents.
#pragma once

#include "upload/geometry.h"

#include <vector>

namespace onde {

/// Of all vertices, as far as the scene needs them.
class VertexAttributes {
  public:
    VertexAttributes(const Scene& scene, FlatGeometry& flat);

    bool tangents() const { return tangents_; }
    uint32_t first_set() const { return first_set_; }

    /// Appends those of vertex i of a mesh, or of none.
    void add(const Mesh* mesh, uint32_t i, uint32_t tangent);

  private:
    FlatGeometry& flat_;
    std::vector<uint32_t> further_sets_;
    uint32_t first_set_;
    bool colors_ = false, tangents_ = false;
};

/// The direction, and in the lowest bit whether w is negative.
uint32_t encode_tangent(const glm::vec4& tangent);

/// For each corner of a mesh's triangles that have normal maps, by the map's own coordinates; zero
/// for others, empty where there are none.
std::vector<glm::vec4> mesh_tangents(const Scene& scene, const Mesh& mesh);

} // namespace onde
