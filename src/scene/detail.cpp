#include "scene/detail.h"

#include "scene/extent.h"

#include <algorithm>
#include <cmath>

namespace onde {

template <class Positions>
static std::vector<Detail> details_of_triangles(const Positions& positions,
                                                std::span<const glm::uvec3> triangles,
                                                size_t most) {
    std::vector<Detail> details;
    const size_t step = triangles.size() / std::max<size_t>(most, 1) + 1;
    for (size_t i = 0; i < triangles.size(); i += step) {
        Extent box;
        for (const uint32_t v : {triangles[i].x, triangles[i].y, triangles[i].z})
            box.grow(glm::dvec3(positions[v]));
        const Detail detail{middle_of(box), half_diagonal(box), double(step)};
        if (detail.size > 0.0 && std::isfinite(detail.size)) details.push_back(detail);
    }
    return details;
}

std::vector<Detail> details_of(std::span<const glm::dvec3> positions,
                               std::span<const glm::uvec3> triangles, size_t most) {
    return details_of_triangles(positions, triangles, most);
}

std::vector<Detail> details_of(const Mesh& mesh, size_t most) {
    return details_of_triangles(mesh.positions, mesh.triangles, most);
}

Detail transformed(const Detail& detail, const glm::dmat4& transform) {
    double scale = 0.0;
    for (glm::length_t k = 0; k < 3; ++k)
        scale = std::max(scale, glm::length(glm::dvec3(transform[k])));
    return {glm::dvec3(transform * glm::dvec4(detail.middle, 1.0)), scale * detail.size,
            detail.weight};
}

size_t most_details(size_t instances) {
    constexpr size_t MOST_OF_MESH = 64;
    return std::min(MOST_DETAILS / (instances + 1) + 1, MOST_OF_MESH);
}

std::vector<Detail> details_of(const Scene& scene) {
    std::vector<std::vector<Detail>> of_meshes;
    for (const Mesh& mesh : scene.meshes)
        of_meshes.push_back(details_of(mesh, most_details(scene.instances.size())));
    std::vector<Detail> details;
    for (const Instance& instance : scene.instances)
        for (const Detail& detail : of_meshes[instance.mesh])
            details.push_back(transformed(detail, glm::dmat4(instance.object_to_world)));
    const auto add = [&](const Extent& box) {
        details.push_back({middle_of(box), half_diagonal(box)});
    };
    for (const Sphere& sphere : scene.spheres) add(extent_of(sphere));
    for (const Shape& shape : scene.shapes) add(extent_of(shape));
    return details;
}

double lost_bits(const Detail& detail, const glm::dvec3& origin) {
    const double times = glm::length(detail.middle - origin) / detail.size;
    return times > FAR_FOR_SIZE ? detail.weight * std::log2(times / FAR_FOR_SIZE) : 0.0;
}

Detail torn_detail(std::span<const Detail> details) {
    Detail torn{glm::dvec3(0.0), 0.0, 0.0};
    double all = 0.0, most = 0.0, weight = 0.0;
    for (const Detail& detail : details) {
        all += detail.weight;
        const double times = glm::length(detail.middle) / detail.size;
        if (!(times > FAR_FOR_SIZE)) continue;
        weight += detail.weight;
        if (times > most) torn = detail;
        most = std::max(most, times);
    }
    torn.weight = all > 0.0 ? weight / all : 0.0;
    return torn;
}

} // namespace onde
