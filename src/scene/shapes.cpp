#include "scene/shapes.h"

#include <utility>

namespace onde {

static void add_rectangle(Mesh& mesh, const glm::vec3& corner, const glm::vec3& edge1,
                          const glm::vec3& edge2, uint32_t material) {
    const uint32_t first = uint32_t(mesh.positions.size());
    for (const glm::vec3& position :
         {corner, corner + edge1, corner + edge1 + edge2, corner + edge2})
        mesh.positions.push_back(position);
    mesh.uvs.insert(mesh.uvs.end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    mesh.triangles.push_back(glm::uvec3(first, first + 1, first + 2));
    mesh.triangles.push_back(glm::uvec3(first, first + 2, first + 3));
    mesh.materials.insert(mesh.materials.end(), 2, material);
}

Mesh rectangle_mesh(const glm::vec3& corner, const glm::vec3& edge1, const glm::vec3& edge2,
                    uint32_t material) {
    Mesh mesh;
    mesh.name = "rectangle";
    add_rectangle(mesh, corner, edge1, edge2, material);
    return mesh;
}

Mesh box_mesh(const glm::vec3& size, uint32_t material) {
    Mesh mesh;
    mesh.name = "box";
    for (size_t axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 normal(0.0f), edge1(0.0f), edge2(0.0f);
            normal[axis] = side * size[axis];
            edge1[(axis + 1) % 3] = size[(axis + 1) % 3];
            edge2[(axis + 2) % 3] = size[(axis + 2) % 3];
            if (side < 0.0f) std::swap(edge1, edge2);
            add_rectangle(mesh, 0.5f * (normal - edge1 - edge2), edge1, edge2, material);
        }
    return mesh;
}

void bake(Mesh& mesh, const glm::mat4& transform) {
    for (glm::vec3& position : mesh.positions)
        position = glm::vec3(transform * glm::vec4(position, 1.0f));
    if (glm::determinant(glm::mat3(transform)) >= 0.0f) return;
    for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
}

} // namespace onde
