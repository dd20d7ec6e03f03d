// From pixel coordinates to a ray: pixel filter, film, thin lens.
#pragma once

#include "scene/scene.h"
#include "support/reference/random.h"

#include <array>

namespace onde::reference {

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction; ///< unit
};

/// Offsets from the pixel centre, distributed as the filter: box of half width 0.5, tent of radius
/// 1, Gaussian of sigma 0.5 cut at 1.5, Blackman-Harris of radius 1.5, each separable. A sample so
/// placed has weight 1 (Ernst et al. 2006, "Filter Importance Sampling").
class PixelFilter {
  public:
    explicit PixelFilter(Filter filter);
    /// The offset along one axis, in pixels.
    float sample(float u) const {
        const float x = u * float(inverse_.size() - 1);
        const auto i = size_t(x);
        return glm::mix(inverse_[i], inverse_[i + 1], x - float(i));
    }

  private:
    std::array<float, 1025> inverse_; ///< of the cumulative distribution
};

class PinholeOrLens {
  public:
    PinholeOrLens(const Camera& camera, uint32_t width, uint32_t height, Filter filter);
    Ray sample(uint32_t x, uint32_t y, Random& random) const;

  private:
    glm::mat4 camera_to_world_;
    glm::vec2 half_size_;  ///< of the film at distance 1
    glm::vec2 resolution_; ///< in pixels
    float aperture_radius_, focus_distance_;
    PixelFilter filter_;
};

} // namespace onde::reference
