// The estimator: the radiance one path brings back.
#pragma once

#include "support/reference/lights.h"
#include "support/reference/reference.h"

namespace onde::reference {

struct RayCounts {
    uint64_t extension = 0, shadow = 0;
};

/// A path tracer with next event estimation (Kajiya 1986; Veach 1997, chapter 9).
class PathTracer {
  public:
    PathTracer(const Geometry& geometry, const Appearance& appearance, const Lights& lights,
               const ReferenceOptions& options)
        : geometry_(geometry), appearance_(appearance), lights_(lights), options_(options) {}

    /// Radiance that arrives along the ray, against its direction.
    glm::vec3 radiance(Ray ray, Random& random, RayCounts& counts) const;

  private:
    struct Vertex;
    Vertex shade(const Hit& hit, const SurfacePoint& point, const glm::vec3& wo) const;
    glm::vec3 direct_light(const Vertex& vertex, Random& random, RayCounts& counts) const;
    /// Weight of emission met by a sampled direction of density bsdf_pdf.
    float emission_weight(float bsdf_pdf, float light_pdf) const;
    /// Weight of a light sample.
    float light_weight(const LightSample& sample, float bsdf_pdf) const;

    const Geometry& geometry_;
    const Appearance& appearance_;
    const Lights& lights_;
    const ReferenceOptions& options_;
};

} // namespace onde::reference
