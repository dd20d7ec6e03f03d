// What of a scene is to keep its shape: floats far from 0 have no digits for it.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace onde {

/// Something of a scene that is to keep its shape: a triangle, a shape, what a camera looks at.
struct Detail {
    glm::dvec3 middle;
    double size;         ///< half its diagonal
    double weight = 1.0; ///< the triangles that it stands for
};

/// How many times its size a detail may lie from where positions are counted: a float there is
/// off by a 128th of it.
inline constexpr double FAR_FOR_SIZE = 131072.0;

/// The most details that are looked at; of more, some evenly spread among them.
inline constexpr size_t MOST_DETAILS = 4096;

/// Some of a mesh's triangles, `most` at the most, evenly spread among them.
std::vector<Detail> details_of(std::span<const glm::dvec3> positions,
                               std::span<const glm::uvec3> triangles, size_t most);
std::vector<Detail> details_of(const Mesh& mesh, size_t most);
std::vector<Detail> details_of(const Scene& scene);
/// Of a mesh that is placed as one of `instances`.
size_t most_details(size_t instances);
Detail transformed(const Detail& detail, const glm::dmat4& transform);

/// What lies so far from where positions are counted that floats have no digits for its shape, and
/// the share of all details that it stands for; weight 0 where nothing does.
Detail torn_detail(std::span<const Detail> details);

/// The bits that a detail lacks where positions are counted from there, times its weight.
double lost_bits(const Detail& detail, const glm::dvec3& origin);

} // namespace onde
