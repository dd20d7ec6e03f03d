// Light from infinity: its radiance by direction, and directions in proportion to it.
#pragma once

#include "scene/scene.h"
#include "support/reference/alias_table.h"
#include "support/reference/random.h"

namespace onde::reference {

class EnvironmentLight {
  public:
    explicit EnvironmentLight(const Environment& environment);

    /// Bilinear in the map: columns wrap around, rows end at the poles.
    glm::vec3 radiance(const glm::vec3& direction) const;

    struct Sample {
        glm::vec3 direction;
        float pdf;
    };
    /// A map pixel by the power of the interpolated map within it, then uniform by solid angle
    /// inside it; uniform over the sphere without a map.
    Sample sample(Random& random) const;
    float pdf(const glm::vec3& direction) const;

    bool is_black() const { return black_; }
    /// Luminance of the radiance integrated over the sphere.
    float integral() const { return integral_; }

  private:
    glm::vec2 to_map(const glm::vec3& direction) const;
    glm::vec3 texel(int x, int y) const;
    float pixel_power(int x, int y) const;
    float pixel_solid_angle(int y) const;

    glm::vec3 scale_;
    float turns_; ///< rotation over 2 pi
    int width_ = 0, height_ = 0;
    std::vector<glm::vec3> texels_;
    AliasTable pixels_;                  ///< empty without a map
    std::vector<float> row_solid_angle_; ///< of one pixel of the row
    bool black_ = true;
    float integral_ = 0.0f;
};

} // namespace onde::reference
