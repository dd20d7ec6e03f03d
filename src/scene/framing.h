// The camera of scenes that bring none.
#pragma once

#include "scene/load.h"

#include <array>
#include <optional>

namespace onde {

/// The share of the picture's tighter side that the subject fills.
inline constexpr float FRAMED_SHARE = 0.885f;

/// Fits one camera to one scene or several, such as the poses of an animation: from the front (+Z),
/// a little from the right and from above, as near as all of them fit into that share of the
/// picture.
class Framing {
  public:
    /// `size`: of the picture in pixels. `all_round`: fits at whatever angle the camera is turned
    /// about the vertical axis through the middle of the first scene's bounds.
    Framing(glm::uvec2 size, bool all_round);

    void add(const Scene& scene);

    /// Of at least one scene.
    Camera camera() const;

  private:
    glm::dmat3 axes_;     ///< right, up and back
    glm::dvec2 tangents_; ///< of half the angles of view that are filled
    bool all_round_;
    std::optional<glm::dvec3> center_; ///< what reaches are measured from
    double radius_ = 1e-6;             ///< of the largest scene
    /// How far the scenes reach: to the left, right, below and above, each with a tangent for every
    /// unit that a point lies nearer, which are the planes of a frustum; and toward the camera.
    std::array<double, 5> reach_;
};

} // namespace onde
