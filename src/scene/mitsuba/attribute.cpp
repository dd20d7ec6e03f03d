#include "scene/mitsuba/attribute.h"

#include "scene/mesh_attribute.h"
#include "scene/mesh_parts.h"

#include <algorithm>
#include <cmath>

namespace onde::mitsuba {
namespace {

glm::vec4 color(const glm::dvec3& numbers, const MeshAttribute& attribute) {
    glm::vec3 share(numbers);
    for (glm::length_t c = 0; c < 3; ++c)
        share[c] = std::isfinite(share[c]) ? std::clamp(share[c], 0.0f, 1.0f) : 0.0f;
    return {glm::mix(attribute.at_zero, attribute.at_one, share), 1.0f};
}

template <class T>
void take_apart(std::vector<T>& values, const std::vector<glm::uvec3>& triangles) {
    if (values.empty()) return;
    std::vector<T> apart;
    apart.reserve(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            apart.push_back(values[triangle[corner]]);
    values = std::move(apart);
}

/// Gives each triangle vertices of its own.
void take_apart(Mesh& mesh) {
    take_apart(mesh.positions, mesh.triangles);
    take_apart(mesh.normals, mesh.triangles);
    take_apart(mesh.uvs, mesh.triangles);
    mesh.more_uvs.clear();
    mesh.tangents.clear();
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        mesh.triangles[i] = glm::uvec3(0, 1, 2) + uint32_t(3 * i);
}

} // namespace

bool color_by(Mesh& mesh, const std::filesystem::path& file, const MeshAttribute& attribute,
              LoadContext& context) {
    constexpr std::string_view VERTEX = "vertex_", FACE = "face_";
    const bool is_of_faces = attribute.name.starts_with(FACE);
    if (!is_of_faces && !attribute.name.starts_with(VERTEX)) return false;
    const std::string name = file.string(), bytes = read_file_within(context, file);
    const auto wanted =
        std::string_view(attribute.name).substr((is_of_faces ? FACE : VERTEX).size());
    std::vector<glm::vec4> colors;
    for (const glm::dvec3& row : ply_attribute(
             name, bytes, is_of_faces ? AttributeOf::faces : AttributeOf::vertices, wanted))
        colors.push_back(color(row, attribute));
    const size_t needed = is_of_faces ? mesh.triangles.size() : mesh.positions.size();
    if (colors.empty() || colors.size() != needed) return false;
    if (is_of_faces) {
        context.spend(3 * mesh.triangles.size(), VERTEX_BYTES, name);
        const std::vector<glm::vec4> of_faces = std::move(colors);
        colors.clear();
        for (const glm::vec4& color : of_faces) colors.insert(colors.end(), 3, color);
        take_apart(mesh);
    }
    mesh.colors = std::move(colors);
    return true;
}

} // namespace onde::mitsuba
