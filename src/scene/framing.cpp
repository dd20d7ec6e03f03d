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

/// The farthest that a point comes along a direction, as it is or turned about the vertical.
double along(const glm::dvec3& direction, const glm::dvec3& point, bool all_round) {
    if (!all_round) return glm::dot(direction, point);
    return direction.y * point.y +
           std::hypot(direction.x, direction.z) * std::hypot(point.x, point.z);
}

} // namespace

Framing::Framing(glm::uvec2 size, bool all_round)
    : axes_(axes_toward(glm::normalize(glm::vec3(0.55f, 0.4f, 1.0f)))),
      tangents_(FRAMED_SHARE * std::tan(0.5 * Camera().vertical_fov) *
                glm::dvec2(double(size.x) / size.y, 1)),
      all_round_(all_round) {
    reach_.fill(-std::numeric_limits<double>::infinity());
}

void Framing::add(const Scene& scene) {
    const SceneBounds bounds = scene_bounds(scene);
    const glm::dvec3 low(bounds.low), high(bounds.high);
    radius_ = std::max(radius_, 0.5 * glm::length(high - low));
    if (!center_) center_ = 0.5 * low + 0.5 * high;
    const glm::dvec3 right = axes_[0], up = axes_[1], back = axes_[2];
    const std::array directions{tangents_.x * back - right, tangents_.x * back + right,
                                tangents_.y * back - up, tangents_.y * back + up, back};
    visit_outline(scene, [&](glm::vec3 point) {
        const glm::dvec3 from_center = glm::dvec3(point) - *center_;
        for (size_t i = 0; i < reach_.size(); ++i)
            reach_[i] = std::max(reach_[i], along(directions[i], from_center, all_round_));
    });
}

Camera Framing::camera() const {
    const auto [left, right, below, above, nearest] = reach_;
    const double fitting = std::max({0.5 * (left + right) / tangents_.x,
                                     0.5 * (below + above) / tangents_.y, nearest + 0.1 * radius_});
    const glm::dvec3 middle(0.5 * (right - left), 0.5 * (above - below), fitting);
    Camera camera;
    camera.name = "framed";
    camera.focus_distance = float(fitting);
    camera.camera_to_world = glm::mat4(glm::mat3(axes_));
    camera.camera_to_world[3] = glm::vec4(glm::vec3(*center_ + axes_ * middle), 1.0f);
    return camera;
}

} // namespace onde
