#include "upload/mesh_writer.h"

#include "upload/bulge.h"
#include "upload/octahedral.h"
#include "upload/triangle_plane.h"
#include "upload/uv_scale.h"
#include "upload/words.h"

namespace onde {

static glm::vec3 point(const glm::mat4& m, glm::vec3 p) {
    return glm::vec3(m * glm::vec4(p, 1.0f));
}

static bool has_vertices(const Mesh& mesh) {
    return !mesh.normals.empty() || !mesh.uvs.empty() || !mesh.more_uvs.empty() ||
           !mesh.colors.empty();
}

void MeshWriter::add(const Mesh& mesh, const glm::mat4& transform) {
    linear_ = glm::mat3(transform);
    normal_matrix_ = glm::transpose(glm::inverse(linear_));
    orientation_ = glm::determinant(linear_) < 0 ? -1.0f : 1.0f;
    first_ = uint32_t(positions_.size());
    first_vertex_ = uint32_t(flat_.vertices.size());
    for (glm::vec3 p : mesh.positions) positions_.push_back(point(transform, p));
    tangents_.clear();
    others_.clear();
    if (attributes_.tangents()) tangents_ = mesh_tangents(scene_, mesh);
    if (has_vertices(mesh))
        for (uint32_t i = 0; i < mesh.positions.size(); i++)
            add_vertex(mesh, i, vertex(mesh, i, glm::vec3(0, 0, 1)), NO_TANGENT);
    for (size_t i = 0; i < mesh.triangles.size(); i++) {
        triangles_.push_back(mesh.triangles[i] + first_);
        add_surface(mesh, i);
    }
}

void MeshWriter::add_vertex(const Mesh& mesh, uint32_t i, const VertexRecord& record,
                            uint32_t tangent) {
    flat_.vertices.push_back(record);
    attributes_.add(&mesh, i, tangent);
}

VertexRecord MeshWriter::vertex(const Mesh& mesh, uint32_t i, glm::vec3 normal) const {
    VertexRecord record{};
    if (!mesh.normals.empty()) normal = unit_or(normal_matrix_ * mesh.normals[i], normal);
    record.normal = encode_octahedral(normal);
    const std::vector<glm::vec2>& uvs = uv_set(mesh, attributes_.first_set());
    if (!uvs.empty()) copy(record.uv, uvs[i]);
    return record;
}

uint32_t MeshWriter::corner_tangent(size_t corner) const {
    if (tangents_.empty() || tangents_[corner].w == 0.0f) return NO_TANGENT;
    const glm::vec3 placed = linear_ * glm::vec3(tangents_[corner]);
    return encode_tangent(
        {unit_or(placed, glm::vec3(1, 0, 0)), tangents_[corner].w * orientation_});
}

uint32_t MeshWriter::corner_vertex(const Mesh& mesh, uint32_t corner, glm::vec3 geometric,
                                   uint32_t tangent) {
    const uint32_t usual = first_vertex_ + corner;
    const VertexRecord own = vertex(mesh, corner, geometric);
    const bool same = mesh.normals.empty() || own.normal == flat_.vertices[usual].normal;
    if (same && tangent != NO_TANGENT && flat_.tangents[usual] == NO_TANGENT)
        flat_.tangents[usual] = tangent;
    if (same && (tangent == NO_TANGENT || flat_.tangents[usual] == tangent)) return usual;
    const auto [other, is_new] = others_.try_emplace(std::tuple(corner, own.normal, tangent),
                                                     uint32_t(flat_.vertices.size()));
    if (is_new) add_vertex(mesh, corner, own, tangent);
    return other->second;
}

void MeshWriter::add_bulge(const Mesh& mesh, glm::uvec3 corners, const glm::vec3 (&p)[3],
                           glm::vec3 geometric) {
    glm::vec3 normals[3];
    for (uint32_t k = 0; k < 3; k++)
        normals[k] = unit_or(normal_matrix_ * mesh.normals[corners[k]], geometric);
    flat_.bulges.resize(flat_.surfaces.size() + 1);
    flat_.bulges.back() = encode_bulge(p, normals, geometric);
}

void MeshWriter::add_uv_scale(const TriangleSurface& surface, const glm::vec3 (&p)[3]) {
    glm::vec2 uvs[3];
    for (uint32_t k = 0; k < 3; k++) {
        const float* uv = flat_.vertices[surface.vertex[k]].uv;
        uvs[k] = {uv[0], uv[1]};
    }
    flat_.uv_scales.resize(flat_.surfaces.size() + 1);
    flat_.uv_scales.back() = uv_scale(p, uvs);
}

void MeshWriter::add_surface(const Mesh& mesh, size_t triangle) {
    const glm::uvec3 corners = mesh.triangles[triangle];
    glm::vec3 p[3];
    for (uint32_t k = 0; k < 3; k++) p[k] = positions_[first_ + corners[k]];
    const TrianglePlane plane = triangle_plane(p, orientation_);
    const glm::vec3 geometric = plane.normal;
    const uint32_t material = mesh.materials[triangle];
    const auto primitive = uint32_t(flat_.surfaces.size());
    TriangleSurface surface{};
    surface.light = NO_INDEX;
    copy(surface.geometric, geometric);
    surface.plane = plane.offset;
    bool flat = true;
    if (has_vertices(mesh)) {
        const uint32_t normal = encode_octahedral(geometric);
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t tangent = corner_tangent(3 * triangle + k);
            surface.vertex[k] = corner_vertex(mesh, corners[k], geometric, tangent);
            flat &= mesh.normals.empty() || flat_.vertices[surface.vertex[k]].normal == normal;
        }
    }
    if (!flat) add_bulge(mesh, corners, p, geometric);
    if (has_uv_scales_) add_uv_scale(surface, p);
    surface.tag = material | SURFACE_REACH(plane.reach) | (flat ? SURFACE_FLAT : 0);
    if (emits(scene_.materials[material]))
        flat_.emissive.push_back(emissive_triangle(primitive, material, p, orientation_));
    flat_.surfaces.emplace_back().triangle = surface;
}

} // namespace onde
