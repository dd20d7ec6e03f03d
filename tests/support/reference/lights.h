// Everything that emits, chosen by power: emissive triangles and spheres, point and directional
// lights, the environment.
#pragma once

#include "support/reference/alias_table.h"
#include "support/reference/environment.h"
#include "support/reference/geometry.h"
#include "support/reference/material.h"

#include <optional>

namespace onde::reference {

/// Light that arrives at a point from one sampled direction.
struct LightSample {
    glm::vec3 direction; ///< unit, toward the light
    glm::vec3 radiance;  ///< for a delta light: irradiance facing it
    float pdf;           ///< per solid angle, the choice of the light included; delta: the choice
    bool delta;
    glm::vec3 target; ///< where the shadow ray ends; unused when infinitely far
    bool infinite;
};

class Lights {
  public:
    Lights(const Scene& scene, const Geometry& geometry, const Appearance& appearance);

    /// Nothing when there are no lights or the sample sends nothing to `position`.
    std::optional<LightSample> sample(const glm::vec3& position, Random& random) const;
    /// Density with which sample(from) finds the surface at `hit`, per solid angle.
    float pdf(const Hit& hit, const SurfacePoint& point, const glm::vec3& from) const;
    /// The same for the environment.
    float environment_pdf(const glm::vec3& direction) const;

    const EnvironmentLight& environment() const { return environment_; }

  private:
    enum class Kind : uint8_t { triangle, sphere, point, directional, environment };
    struct Light {
        Kind kind;
        uint32_t index; ///< into triangles_, spheres, point_lights_ or directional_lights_
    };
    struct TriangleLight {
        WorldTriangle corners;
        glm::vec3 normal;
        float area;
        float clearance;
    };
    static constexpr uint32_t NO_LIGHT = ~0u;

    void add_triangles(uint32_t shape);
    void add_spheres();
    void add_light(Kind kind, size_t index, float power);
    uint32_t light_of(const Hit& hit) const;
    std::optional<LightSample> sample_triangle_light(const TriangleLight& light,
                                                     const glm::vec3& position,
                                                     Random& random) const;
    std::optional<LightSample> sample_sphere_light(const Sphere& sphere, const glm::vec3& position,
                                                   Random& random) const;
    LightSample sample_environment(Random& random) const;

    const Geometry& geometry_;
    const Appearance& appearance_;
    EnvironmentLight environment_;
    std::vector<Light> lights_;
    std::vector<float> powers_;
    std::vector<TriangleLight> triangles_;
    std::vector<PointLight> point_lights_;
    std::vector<DirectionalLight> directional_lights_;
    std::vector<std::vector<uint32_t>> light_of_; ///< per shape and primitive; empty: none
    uint32_t environment_index_ = NO_LIGHT;
    AliasTable choice_;
};

} // namespace onde::reference
