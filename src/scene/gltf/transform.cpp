// The transform of a node by itself (glTF 2.0, section 3.5.3).
#include "core/error.h"
#include "scene/gltf/pose.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <tuple>

namespace onde::gltf {

/// A row of 0, 0, 0, 1 but for rounding.
static bool is_affine(const std::array<double, 16>& m) {
    constexpr double ROUNDING = 1e-4;
    return std::abs(m[3]) <= ROUNDING && std::abs(m[7]) <= ROUNDING &&
           std::abs(m[11]) <= ROUNDING && std::abs(m[15] - 1.0) <= ROUNDING;
}

glm::dmat4 local_transform(const File& file, const Node& node, const std::string& user) {
    glm::dmat4 m(1.0);
    if (node.matrix) {
        if (!is_affine(*node.matrix))
            throw InputError("{}: {}: its matrix is not affine; export it again", file.name, user);
        for (size_t i = 0; i < 16; ++i)
            if (i % 4 < 3) m[i / 4][i % 4] = (*node.matrix)[i];
        return m;
    }
    const auto& [t, r, s] = std::tie(node.translation, node.rotation, node.scale);
    m = glm::translate(m, glm::dvec3(t[0], t[1], t[2]));
    const glm::dquat rotation(r[3], r[0], r[1], r[2]);
    if (!(glm::length(rotation) > 1e-12))
        throw InputError("{}: {}: its rotation is no quaternion; export it again", file.name, user);
    return glm::scale(m * glm::mat4_cast(glm::normalize(rotation)), glm::dvec3(s[0], s[1], s[2]));
}

} // namespace onde::gltf
