#include "support/reference/path.h"

#include "support/reference/bsdf.h"

namespace onde::reference {

struct PathTracer::Vertex {
    SurfacePoint point;
    glm::vec3 emission; ///< toward the viewer
    float bulge;        ///< on the viewer's side
    Bsdf bsdf;

    /// The origin of a ray that leaves to the side of `direction`, or from the curved surface.
    glm::vec3 leave(const glm::vec3& direction) const {
        if (bsdf.leaves_curve(direction))
            return point.position + (point.clearance + bulge) * bsdf.geometric_normal();
        return leave_surface(point, direction);
    }
};

PathTracer::Vertex PathTracer::shade(const Hit& hit, const SurfacePoint& point,
                                     const glm::vec3& wo) const {
    const MaterialRecord& material = appearance_.material(point.material);
    const bool needs_uv = material.textured || material.normal_texture != NO_TEXTURE ||
                          material.emission_texture != NO_TEXTURE;
    const glm::vec2 uv = needs_uv ? geometry_.uv(hit) : glm::vec2(0.0f);
    const bool front = glm::dot(point.geometric_normal, wo) >= 0.0f;
    const glm::vec3 emission =
        material.emits() ? appearance_.emission(material, uv, front) : glm::vec3(0.0f);
    glm::vec3 normal = point.shading_normal;
    if (material.normal_texture != NO_TEXTURE)
        normal = appearance_.mapped_normal(material, uv, geometry_.tangents(hit), normal);
    const float bulge = front ? point.front_bulge : point.back_bulge;
    const MaterialRecord here = material.textured ? appearance_.at(material, uv) : material;
    return {point, emission, bulge, Bsdf(here, point.geometric_normal, normal, wo, bulge > 0.0f)};
}

float PathTracer::emission_weight(float bsdf_pdf, float light_pdf) const {
    switch (options_.technique) {
    case Technique::light_only:
        return 0.0f;
    case Technique::bsdf_only:
        return 1.0f;
    case Technique::mis:
        break;
    }
    return power_heuristic(bsdf_pdf, light_pdf);
}

float PathTracer::light_weight(const LightSample& sample, float bsdf_pdf) const {
    if (sample.delta || options_.technique == Technique::light_only) return 1.0f;
    if (options_.technique == Technique::bsdf_only) return 0.0f;
    return power_heuristic(sample.pdf, bsdf_pdf);
}

glm::vec3 PathTracer::direct_light(const Vertex& vertex, Random& random, RayCounts& counts) const {
    const std::optional<LightSample> light = lights_.sample(vertex.point.position, random);
    if (!light) return glm::vec3(0.0f);
    const Scattering scattering = vertex.bsdf.eval(light->direction);
    const float weight = light_weight(*light, scattering.pdf);
    const glm::vec3 contribution = scattering.value * light->radiance * (weight / light->pdf);
    if (contribution == glm::vec3(0.0f)) return contribution;
    const glm::vec3 origin = vertex.leave(light->direction);
    const glm::vec3 along = light->infinite ? light->direction : light->target - origin;
    const float distance = light->infinite ? std::numeric_limits<float>::infinity() : 1.0f;
    ++counts.shadow;
    return geometry_.occluded(origin, along, distance) ? glm::vec3(0.0f) : contribution;
}

glm::vec3 PathTracer::radiance(Ray ray, Random& random, RayCounts& counts) const {
    glm::vec3 radiance(0.0f), throughput(1.0f);
    glm::vec3 previous = ray.origin; // the point from which the ray was sampled,
    float bsdf_pdf = 0.0f;           // with this density,
    bool specular = true;            // unless by a delta lobe or the camera
    for (uint32_t vertex_index = 0; vertex_index < options_.depth; ++vertex_index) {
        ++counts.extension;
        const std::optional<Hit> hit = geometry_.intersect(ray);
        if (!hit) {
            if (lights_.environment().is_black()) break;
            const float weight =
                specular ? 1.0f : emission_weight(bsdf_pdf, lights_.environment_pdf(ray.direction));
            return radiance + throughput * lights_.environment().radiance(ray.direction) * weight;
        }
        const SurfacePoint point = geometry_.surface_point(*hit);
        const Vertex vertex = shade(*hit, point, -ray.direction);
        if (vertex.emission != glm::vec3(0.0f)) {
            const float weight =
                specular ? 1.0f : emission_weight(bsdf_pdf, lights_.pdf(*hit, point, previous));
            radiance += throughput * vertex.emission * weight;
        }
        if (vertex_index + 1 == options_.depth) break;
        if (vertex.bsdf.has_smooth_lobe())
            radiance += throughput * direct_light(vertex, random, counts);
        const std::optional<ScatteringSample> next = vertex.bsdf.sample(random);
        if (!next) break;
        throughput *= next->weight;
        if (throughput == glm::vec3(0.0f)) break;
        if (vertex_index >= options_.roulette_start) {
            const float survival = glm::clamp(max_component(throughput), 0.05f, 0.95f);
            if (random.next() >= survival) break;
            throughput /= survival;
        }
        previous = point.position;
        bsdf_pdf = next->pdf;
        specular = next->specular;
        ray = {vertex.leave(next->direction), next->direction};
    }
    return radiance;
}

} // namespace onde::reference
