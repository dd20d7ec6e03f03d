#include "scene/tube.h"

#include <cmath>
#include <numbers>

namespace onde {

Mesh tube_mesh() {
    constexpr uint32_t FACETS = 128;
    Mesh mesh;
    mesh.name = "cylinder";
    for (uint32_t i = 0; i <= FACETS; ++i) {
        const double part = double(i) / FACETS, angle = 2.0 * std::numbers::pi * part;
        const glm::vec3 normal(std::cos(angle), std::sin(angle), 0.0);
        for (const float z : {0.0f, 1.0f}) {
            mesh.positions.push_back(normal + glm::vec3(0.0f, 0.0f, z));
            mesh.normals.push_back(normal);
            mesh.uvs.emplace_back(part, 1.0f - z);
        }
    }
    for (uint32_t i = 0; i < 2 * FACETS; i += 2) {
        mesh.triangles.emplace_back(i, i + 2, i + 3);
        mesh.triangles.emplace_back(i, i + 3, i + 1);
    }
    mesh.materials.assign(mesh.triangles.size(), 0);
    return mesh;
}

} // namespace onde
