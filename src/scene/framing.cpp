#include "scene/framing.h"

#include "scene/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace onde {
namespace {

/// Right, up and back of a camera that looks along -back.
glm::mat3 axes_toward(glm::vec3 back) {
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back));
    return {right, glm::cross(back, right), back};
}

/// How far the scene reaches to the four sides of a view without perspective, with `tangents` added
/// for every unit that a point lies nearer: half-planes of a frustum by their offsets.
struct Reach {
    glm::dvec2 low{-std::numeric_limits<double>::infinity()};
    glm::dvec2 high{-std::numeric_limits<double>::infinity()};
    double nearest = -std::numeric_limits<double>::infinity();

    void grow(glm::dvec3 view, glm::dvec2 tangents) {
        const glm::dvec2 side(view), bend = tangents * view.z;
        low = glm::max(low, bend - side);
        high = glm::max(high, bend + side);
        nearest = std::max(nearest, view.z);
    }
};

} // namespace

Camera framing_camera(const Scene& scene, glm::uvec2 size) {
    Camera camera;
    camera.name = "framed";
    const double tangent = FRAMED_SHARE * std::tan(0.5 * camera.vertical_fov);
    const glm::dvec2 tangents = tangent * glm::dvec2(double(size.x) / size.y, 1);
    const glm::mat3 axes = axes_toward(glm::normalize(glm::vec3(0.55f, 0.4f, 1.0f)));
    const SceneBounds bounds = scene_bounds(scene);
    const glm::dvec3 center = 0.5 * glm::dvec3(bounds.low) + 0.5 * glm::dvec3(bounds.high);
    const double radius = std::max(0.5 * glm::length(glm::dvec3(bounds.high - bounds.low)), 1e-6);
    const glm::dmat3 to_view = glm::transpose(glm::dmat3(axes));
    Reach reach;
    visit_outline(scene, [&](glm::vec3 point) {
        reach.grow(to_view * (glm::dvec3(point) - center), tangents);
    });
    const glm::dvec2 distances = 0.5 * (reach.low + reach.high) / tangents;
    const double fitting = std::max({distances.x, distances.y, reach.nearest + 0.1 * radius});
    const glm::dvec2 middle = 0.5 * (reach.high - reach.low);
    const glm::dvec3 eye = center + glm::dmat3(axes) * glm::dvec3(middle, fitting);
    camera.focus_distance = float(fitting);
    camera.camera_to_world = glm::mat4(axes);
    camera.camera_to_world[3] = glm::vec4(glm::vec3(eye), 1.0f);
    return camera;
}

} // namespace onde
