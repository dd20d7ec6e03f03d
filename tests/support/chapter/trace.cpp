#include "support/chapter/trace.h"

#include "support/chapter/eye.h"

#include <algorithm>
#include <stdexcept>

namespace onde::chapter {
namespace {

using glm::dvec2;
using glm::dvec3;

double largest(const dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

/// v mirrored about the unit vector n.
dvec3 mirror(const dvec3& v, const dvec3& n) {
    return 2 * glm::dot(n, v) * n - v;
}

/// Snell's law for `eta` = n1 / n2; none beyond the critical angle. `view` points away from n's
/// surface on n's side.
std::optional<dvec3> refract(const dvec3& view, const dvec3& n, double eta) {
    const double cos1 = glm::dot(n, view);
    const double sin2_squared = eta * eta * (1 - cos1 * cos1);
    if (sin2_squared >= 1) return {};
    return glm::normalize(eta * (cos1 * n - view) - std::sqrt(1 - sin2_squared) * n);
}

/// The unpolarised reflectance of a dielectric, 1 beyond the critical angle.
double fresnel(double cos1, double eta) {
    const double sin2_squared = eta * eta * (1 - cos1 * cos1);
    if (sin2_squared >= 1) return 1;
    const double cos2 = std::sqrt(1 - sin2_squared);
    const double s = (eta * cos1 - cos2) / (eta * cos1 + cos2);
    const double p = (cos1 - eta * cos2) / (cos1 + eta * cos2);
    return 0.5 * (s * s + p * p);
}

} // namespace

/// What a ray has behind it.
struct Tracer::Way {
    uint32_t depth;               ///< of the node at its end; the camera ray's is 1
    dvec3 product;                ///< of all factors
    const Wavelength* wavelength; ///< null: white
    uint32_t sample;
    uint64_t* structure;

    void mark(uint64_t choice) const {
        *structure = (*structure ^ (choice + 0x9e3779b97f4a7c15u)) * 0xff51afd7ed558ccdu;
        *structure ^= *structure >> 32;
    }
};

/// A ray that a node starts.
struct Tracer::Step {
    dvec3 direction, factor;
    const Wavelength* wavelength;
    bool at_source = false; ///< the reflection of the surface it meets is a factor as well
};

Tracer::Tracer(const Scene& scene, uint32_t depth)
    : scene_(scene), world_(scene), depth_(depth),
      wavelengths_(split_white(scene.whitted.wavelengths)) {
    if (!scene.textures.empty()) throw std::invalid_argument("textures");
    if (scene.environment.map) throw std::invalid_argument("an environment map");
}

dvec3 Tracer::background() const {
    return dvec3(scene_.whitted.background.value_or(scene_.environment.radiance));
}

dvec3 Tracer::sum(const dvec3& a, const dvec3& b) const {
    return scene_.whitted.saturate ? glm::min(a + b, 1.0) : a + b;
}

/// The light that a source of strength 1 in that direction sends back to the viewer, over Co.
dvec3 Tracer::lit(const Surface& at, const dvec3& view, const dvec3& to_sample, double reach,
                  const Way& way) const {
    const Phong& phong = scene_.materials[at.material].phong;
    const double facing = glm::dot(to_sample, at.normal);
    way.mark(facing > 0);
    if (facing <= 0) return dvec3(0);
    uint32_t crossings = 0;
    const double left =
        world_.transmitted({at.point, to_sample}, reach, scene_.materials, crossings);
    way.mark(left > 0 ? crossings : 1000);
    const double highlight = std::max(glm::dot(mirror(to_sample, at.normal), view), 0.0);
    return dvec3(left * (double(phong.diffuse) * facing +
                         double(phong.specular) * std::pow(highlight, double(phong.exponent))));
}

dvec3 Tracer::lit_by(const AreaLight& light, const Surface& at, const dvec3& view,
                     const Way& way) const {
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

dvec3 Tracer::direct(const Surface& at, const dvec3& view, const Way& way) const {
    const Material& material = scene_.materials[at.material];
    const dvec3 own(material.base_color);
    const dvec3 ambient(scene_.whitted.ambient.value_or(scene_.environment.radiance));
    dvec3 total = double(material.phong.ambient) * ambient * own;
    const auto add = [&](const glm::vec3& strength, const dvec3& received) {
        total = sum(total, dvec3(strength) * own * received);
    };
    for (const PointLight& light : scene_.point_lights) {
        const dvec3 way_there = dvec3(light.position) - at.point;
        const double distance = glm::length(way_there);
        add(light.strength, lit(at, view, way_there / distance, distance * (1 - 1e-4), way));
    }
    for (const DirectionalLight& light : scene_.directional_lights)
        add(light.strength, lit(at, view, glm::normalize(dvec3(light.to_light)), INFINITY, way));
    for (const AreaLight& light : scene_.area_lights)
        add(light.strength, lit_by(light, at, view, way));
    return total;
}

std::vector<Tracer::Step> Tracer::steps(const Surface& at, const dvec3& view,
                                        const Way& way) const {
    const Material& material = scene_.materials[at.material];
    const Phong& phong = material.phong;
    const double reflection = double(phong.reflection);
    double transmission = double(phong.transmission);
    const bool transparent = transmission > 0;
    const auto eta = [&](double index) { return at.front ? 1 / index : index; };
    const double index = double(material.ior);
    double mirrored = 0; // what Fresnel's formula takes from the transmitted ray
    if (scene_.whitted.fresnel && transparent) {
        const double share = fresnel(glm::dot(at.normal, view), eta(index));
        mirrored = transmission * share;
        transmission *= 1 - share;
    }
    const dvec3 reflected = mirror(view, at.normal);
    std::vector<Step> result;
    if (scene_.whitted.source_reflectivity)
        result.push_back({reflected, dvec3(scene_.whitted.fresnel && transparent ? mirrored : 1.0),
                          way.wavelength, true});
    else
        result.push_back({reflected, dvec3(std::min(reflection + mirrored, 1.0)), way.wavelength});
    if (!transparent) return result;
    const auto transmit = [&](double n, const dvec3& filter, const Wavelength* wavelength) {
        const auto refracted = refract(view, at.normal, eta(n));
        way.mark(refracted.has_value());
        result.push_back({refracted.value_or(reflected), transmission * filter, wavelength});
    };
    const double abbe = double(phong.abbe);
    if (abbe > 0 && !way.wavelength)
        for (const Wavelength& wavelength : wavelengths_)
            transmit(refractive_index(index, abbe, wavelength.micrometres), wavelength.filter,
                     &wavelength);
    else if (abbe > 0)
        transmit(refractive_index(index, abbe, way.wavelength->micrometres), dvec3(1),
                 way.wavelength);
    else
        transmit(index, dvec3(1), way.wavelength);
    return result;
}

dvec3 Tracer::child(const Step& step, const Surface& from, const Way& way) const {
    const Ray ray{from.point, step.direction};
    dvec3 factor = step.factor;
    const double epsilon = double(scene_.whitted.epsilon);
    if (largest(way.product * factor) <= epsilon) return dvec3(0);
    const auto hit = world_.nearest(ray);
    way.mark(hit ? hit->primitive : 0);
    if (step.at_source && hit) {
        factor *= double(scene_.materials[hit->material].phong.reflection);
        const bool counts = largest(way.product * factor) > epsilon;
        way.mark(counts);
        if (!counts) return dvec3(0);
    }
    if (!hit) return factor * background();
    const Way further{way.depth + 1, way.product * factor, step.wavelength, way.sample,
                      way.structure};
    const double falloff = scene_.whitted.distance_falloff ? hit->t * hit->t : 1;
    return factor * colour(*hit, ray, further) / falloff;
}

dvec3 Tracer::colour(const Surface& at, const Ray& ray, const Way& way) const {
    way.mark(at.front);
    const Material& material = scene_.materials[at.material];
    const dvec3 view = -ray.direction;
    const bool emits = at.front || material.two_sided;
    dvec3 total = sum(emits ? dvec3(material.emission) : dvec3(0), direct(at, view, way));
    if (way.depth < depth_)
        for (const Step& step : steps(at, view, way)) total = sum(total, child(step, at, way));
    return total;
}

Seen Tracer::sample(glm::uvec2 size, const dvec2& film, uint32_t number) const {
    Seen seen;
    const Ray ray = camera_ray(scene_.cameras.at(0), size, film);
    const auto hit = world_.nearest(ray);
    const Way way{1, dvec3(1), nullptr, number, &seen.structure};
    way.mark(hit ? hit->primitive : 0);
    seen.colour = hit ? colour(*hit, ray, way) : background();
    return seen;
}

Seen Tracer::pixel(glm::uvec2 size, glm::uvec2 at, uint32_t samples, const dvec2& shift) const {
    Seen mean;
    for (uint32_t s = 0; s < samples; ++s) {
        const Seen one = sample(size, dvec2(at) + r2_sample(s) + shift, s);
        mean.colour += one.colour / double(samples);
        mean.structure = mean.structure * 31 + one.structure;
    }
    return mean;
}

} // namespace onde::chapter
