#include "chapter/triangle_soup.h"

#include "core/error.h"

namespace onde {

static void add(TriangleSoup& soup, const Mesh& mesh, const glm::mat4& object_to_world) {
    std::vector<uint32_t> place(mesh.positions.size(), UINT32_MAX);
    for (const glm::uvec3& triangle : mesh.triangles) {
        glm::uvec3 corners;
        for (size_t k = 0; k < 3; ++k) {
            uint32_t& at = place[triangle[k]];
            if (at == UINT32_MAX) {
                at = uint32_t(soup.positions.size());
                const glm::vec4 position(mesh.positions[triangle[k]], 1.0f);
                soup.positions.emplace_back(object_to_world * position);
            }
            corners[k] = at;
        }
        soup.triangles.push_back(corners);
    }
}

TriangleSoup scene_triangles(const Scene& scene) {
    TriangleSoup soup;
    for (const Instance& instance : scene.instances)
        add(soup, scene.meshes[instance.mesh], instance.object_to_world);
    if (soup.triangles.empty())
        throw InputError(
            "the scene has no triangles to put volumes around; choose one with a mesh");
    return soup;
}

} // namespace onde
