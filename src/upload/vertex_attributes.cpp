#include "upload/vertex_attributes.h"

#include "upload/octahedral.h"
#include "upload/tangents.h"
#include "upload/textures.h"

namespace onde {

VertexAttributes::VertexAttributes(const Scene& scene, FlatGeometry& flat)
    : flat_(flat), further_sets_(used_uv_sets(scene)), first_set_(further_sets_[0]) {
    further_sets_.erase(further_sets_.begin());
    for (const Mesh& mesh : scene.meshes) colors_ |= !mesh.colors.empty();
    for (const Material& m : scene.materials) tangents_ |= has_tangents(m);
}

void VertexAttributes::add(const Mesh* mesh, uint32_t i, uint32_t tangent) {
    for (const uint32_t set : further_sets_) {
        const bool has = mesh && !uv_set(*mesh, set).empty();
        const glm::vec2 uv = has ? uv_set(*mesh, set)[i] : glm::vec2(0.0f);
        flat_.uvs.insert(flat_.uvs.end(), {uv.x, uv.y});
    }
    if (colors_) {
        const bool has = mesh && !mesh->colors.empty();
        const glm::vec4 color = has ? mesh->colors[i] : glm::vec4(1.0f);
        const glm::vec4 scaled = glm::clamp(color, 0.0f, 1.0f) * 65535.0f + 0.5f;
        flat_.colors.push_back(uint32_t(scaled.x) | uint32_t(scaled.y) << 16);
        flat_.colors.push_back(uint32_t(scaled.z) | uint32_t(scaled.w) << 16);
    }
    if (tangents_) flat_.tangents.push_back(tangent);
}

uint32_t encode_tangent(const glm::vec4& tangent) {
    return (encode_octahedral(glm::vec3(tangent)) & ~1u) | uint32_t(tangent.w < 0);
}

/// Of surfaces that have a grain without a picture.
static const Texture PLAIN{};

/// The material of a triangle that needs tangents: its own, else the one it is blended with.
static const Material& tangent_material(const Scene& scene, const Mesh& mesh, uint32_t triangle) {
    const Material& own = scene.materials[mesh.materials[triangle]];
    return has_tangents(own) || !own.blend_with ? own : scene.materials[*own.blend_with];
}

std::vector<glm::vec4> mesh_tangents(const Scene& scene, const Mesh& mesh) {
    std::vector<uint32_t> mapped; // triangles
    for (uint32_t t = 0; t < mesh.triangles.size(); t++)
        if (has_tangents(tangent_material(scene, mesh, t))) mapped.push_back(t);
    if (mapped.empty()) return {};
    std::vector<TangentCorner> corners;
    corners.reserve(3 * mapped.size());
    for (const uint32_t t : mapped) {
        const glm::uvec3 v = mesh.triangles[t];
        const auto& p = mesh.positions;
        const int32_t index = tangent_map_of(tangent_material(scene, mesh, t));
        const Texture& texture = index == NO_TEXTURE ? PLAIN : scene.textures[size_t(index)];
        const std::vector<glm::vec2>& uvs = uv_set(mesh, texture.uv_set);
        const glm::vec3 flat =
            unit_or(glm::cross(p[v.y] - p[v.x], p[v.z] - p[v.x]), glm::vec3(0, 0, 1));
        for (glm::length_t k = 0; k < 3; k++)
            corners.push_back({p[v[k]], mesh.normals.empty() ? flat : mesh.normals[v[k]],
                               texture.transform(uvs.empty() ? glm::vec2(0.0f) : uvs[v[k]])});
    }
    const std::vector<glm::vec4> computed = corner_tangents(corners);
    std::vector<glm::vec4> tangents(3 * mesh.triangles.size(), glm::vec4(0.0f));
    for (size_t i = 0; i < mapped.size(); i++)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t vertex = mesh.triangles[mapped[i]][glm::length_t(k)];
            const bool own = !mesh.tangents.empty() && mesh.tangents[vertex].w != 0.0f;
            tangents[3 * mapped[i] + k] = own ? mesh.tangents[vertex] : computed[3 * i + k];
        }
    return tangents;
}

} // namespace onde
