// Meshes as triangles and vertices of a geometry.
#pragma once

#include "scene/texture_levels.h"
#include "upload/vertex_attributes.h"

#include <map>
#include <tuple>
#include <vector>

namespace onde {

/// Writes the primitives of one mesh, placed by `transform`, to a geometry's arrays.
class MeshWriter {
  public:
    MeshWriter(const Scene& scene, FlatGeometry& flat, std::vector<glm::vec3>& positions,
               std::vector<glm::uvec3>& triangles)
        : scene_(scene), flat_(flat), positions_(positions), triangles_(triangles),
          attributes_(scene, flat), has_uv_scales_(has_mip_textures(scene)) {}

    void add(const Mesh& mesh, const glm::mat4& transform);

  private:
    static constexpr uint32_t NO_TANGENT = 0x80008000u; // what no direction is encoded as

    void add_vertex(const Mesh& mesh, uint32_t i, const VertexRecord& record, uint32_t tangent);

    /// A vertex whose normal is `normal` where the mesh has no usable one.
    VertexRecord vertex(const Mesh& mesh, uint32_t i, glm::vec3 normal) const;

    /// A corner's tangent in the space of the geometry.
    uint32_t corner_tangent(size_t corner) const;

    /// The index of a corner's vertex: of another one where the mesh's has no usable normal, or
    /// another tangent.
    uint32_t corner_vertex(const Mesh& mesh, uint32_t corner, glm::vec3 geometric,
                           uint32_t tangent);

    /// Of a curved triangle: how it bulges.
    void add_bulge(const Mesh& mesh, glm::uvec3 corners, const glm::vec3 (&p)[3],
                   glm::vec3 geometric);

    /// How much the coordinates of its first set grow.
    void add_uv_scale(const TriangleSurface& surface, const glm::vec3 (&p)[3]);

    void add_surface(const Mesh& mesh, size_t triangle);

    const Scene& scene_;
    FlatGeometry& flat_;
    std::vector<glm::vec3>& positions_;
    std::vector<glm::uvec3>& triangles_;
    VertexAttributes attributes_;
    bool has_uv_scales_;
    // Of the mesh that is being added.
    glm::mat3 linear_{1.0f}, normal_matrix_{1.0f};
    std::vector<glm::vec4> tangents_; ///< by corner of its triangles, or empty
    std::map<std::tuple<uint32_t, uint32_t, uint32_t>, uint32_t> others_; ///< see corner_vertex()
    float orientation_ = 1.0f;
    uint32_t first_ = 0, first_vertex_ = 0;
};

} // namespace onde
