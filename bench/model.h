// The triangles of which benches build trees and at which they shoot, in world space, and the eye
// that looks at them.
#pragma once

#include "accel/bvh.h"
#include "scene/scene.h"

#include <string>

namespace onde::bench {

struct Model {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    Camera camera;
    glm::vec3 light{0.0f}; ///< where shadow rays go, give or take a twentieth of the extent
    glm::vec3 low{0.0f}, high{0.0f};

    float extent() const { return glm::length(high - low); }
    Geometry geometry() const { return {positions, triangles, {}, 0}; }
};

/// A scene file with its instances flattened; spheres and other shapes are left out. The light is
/// the first point light, or a point above the middle. Throws InputError when there is no triangle.
Model load_model(const std::string& path);

/// One model a path; without any path, a terrain of a million triangles.
std::vector<Model> load_models(const std::vector<std::string>& paths);

/// A bumpy height field of 2 cells^2 triangles.
Model terrain_model(uint32_t cells);

} // namespace onde::bench
