// The recursive colour of docs/whitted.md, in double precision.
#pragma once

#include "support/chapter/spectrum.h"
#include "support/chapter/world.h"

namespace onde::chapter {

/// What a sample saw. Two samples of the same `structure` met the same surfaces in the same order,
/// were lit by the same sources and stopped for the same reasons: no edge lies between them.
struct Seen {
    glm::dvec3 colour{0};
    uint64_t structure = 0;
};

class Tracer {
  public:
    /// The scene is complete and outlives the tracer. Throws std::invalid_argument for textures and
    /// environment maps, which the chapter lacks.
    Tracer(const Scene& scene, uint32_t depth);

    /// The colour at that film position (see camera_ray) of a film of `size` pixels, in the sample
    /// of that number.
    Seen sample(glm::uvec2 size, const glm::dvec2& film, uint32_t number) const;

    /// The mean of samples 0 to `samples` - 1 of a pixel, its film positions moved by `shift`.
    Seen pixel(glm::uvec2 size, glm::uvec2 at, uint32_t samples,
               const glm::dvec2& shift = glm::dvec2(0)) const;

  private:
    struct RayHistory;
    struct Step;
    glm::dvec3 background() const;
    glm::dvec3 sum(const glm::dvec3& a, const glm::dvec3& b) const;
    glm::dvec3 colour(const Surface& at, const Ray& ray, const RayHistory& way) const;
    glm::dvec3 direct(const Surface& at, const glm::dvec3& view, const RayHistory& way) const;
    glm::dvec3 lit(const Surface& at, const glm::dvec3& view, const glm::dvec3& to_sample,
                   double reach, const RayHistory& way) const;
    glm::dvec3 lit_by(const AreaLight& light, const Surface& at, const glm::dvec3& view,
                      const RayHistory& way) const;
    glm::dvec3 child(const Step& step, const Surface& from, const RayHistory& way) const;
    std::vector<Step> steps(const Surface& at, const glm::dvec3& view, const RayHistory& way) const;

    const Scene& scene_;
    World world_;
    uint32_t depth_;
    std::vector<Wavelength> wavelengths_;
};

} // namespace onde::chapter
