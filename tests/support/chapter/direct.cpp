// The light that a point gets straight from the sources.
#include "scene/phong.h"
#include "support/chapter/eye.h"
#include "support/chapter/ray_history.h"

#include <algorithm>

namespace onde::chapter {

using glm::dvec2;
using glm::dvec3;

/// The light that a source of intensity 1 in that direction sends back to the viewer, over Co.
dvec3 Tracer::lit(const Surface& at, const dvec3& view, const dvec3& to_sample, double reach,
                  const RayHistory& way) const {
    const Phong phong = phong_of(scene_, at.material);
    const double facing = glm::dot(to_sample, at.normal);
    way.mark(facing > 0);
    if (facing <= 0) return dvec3(0);
    uint32_t crossings = 0;
    const double left = world_.transmitted({at.point, to_sample}, reach, scene_, crossings);
    way.mark(left > 0 ? crossings : 1000);
    const double highlight = std::max(glm::dot(mirror(to_sample, at.normal), view), 0.0);
    return dvec3(left * (double(phong.diffuse) * facing +
                         double(phong.specular) * std::pow(highlight, double(phong.exponent))));
}

dvec3 Tracer::lit_by(const AreaLight& light, const Surface& at, const dvec3& view,
                     const RayHistory& way) const {
    const dvec2 offset = r2_sample(way.sample);
    const dvec3 position(light.position);
    dvec3 edge1(light.edge1), edge2(light.edge2);
    const dvec3 front = glm::cross(edge1, edge2);
    const double radius = double(light.radius);
    if (light.kind == AreaLightKind::sphere) {
        const dvec3 w = glm::normalize(at.point - position);
        const bool along_x = std::abs(w.x) > 0.9;
        way.mark(along_x);
        edge1 = glm::normalize(glm::cross(w, along_x ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
        edge2 = glm::cross(w, edge1);
        edge1 *= radius;
        edge2 *= radius;
    }
    dvec3 total(0);
    for (uint32_t j = 0; j < light.samples; ++j)
        for (uint32_t i = 0; i < light.samples; ++i) {
            const double u = (i + offset.x) / light.samples, v = (j + offset.y) / light.samples;
            const double angle = 2 * M_PI * v;
            const dvec3 from =
                light.kind == AreaLightKind::rectangle
                    ? position + u * edge1 + v * edge2
                    : position + std::sqrt(u) * (std::cos(angle) * edge1 + std::sin(angle) * edge2);
            const bool one_sided = light.kind != AreaLightKind::sphere && !light.two_sided;
            const bool behind = one_sided && glm::dot(front, at.point - from) <= 0;
            way.mark(behind);
            if (behind) continue;
            const double distance = glm::length(from - at.point);
            const dvec3 l = (from - at.point) / distance;
            double reach = distance * (1 - 1e-4);
            if (light.kind == AreaLightKind::sphere)
                for (const Crossing& entry :
                     cross_sphere({(at.point - position) / radius, l / radius}))
                    reach = std::min(reach, entry.t * (1 - 1e-6));
            total += lit(at, view, l, reach, way);
        }
    return total / double(light.samples * light.samples);
}

dvec3 Tracer::direct(const Surface& at, const dvec3& view, const RayHistory& way) const {
    const Material& material = scene_.materials[at.material];
    const dvec3 own(material.base_color);
    const dvec3 ambient(scene_.chapter.whitted.ambient.value_or(scene_.environment.radiance));
    dvec3 total = double(phong_of(scene_, at.material).ambient) * ambient * own;
    const auto add = [&](const glm::vec3& intensity, const dvec3& received) {
        total = sum(total, dvec3(intensity) * own * received);
    };
    for (uint32_t i = 0; i < scene_.point_lights.size(); ++i) {
        const dvec3 way_there = dvec3(scene_.point_lights[i].position) - at.point;
        const double distance = glm::length(way_there);
        add(point_intensity(scene_, i),
            lit(at, view, way_there / distance, distance * (1 - 1e-4), way));
    }
    for (uint32_t i = 0; i < scene_.directional_lights.size(); ++i) {
        const dvec3 to_light(scene_.directional_lights[i].to_light);
        add(directional_intensity(scene_, i),
            lit(at, view, glm::normalize(to_light), INFINITY, way));
    }
    for (const AreaLight& light : scene_.chapter.area_lights)
        add(light.intensity, lit_by(light, at, view, way));
    return total;
}

} // namespace onde::chapter
