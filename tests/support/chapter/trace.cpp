#include "support/chapter/trace.h"

#include "scene/phong.h"
#include "support/chapter/eye.h"
#include "support/chapter/ray_history.h"

#include <algorithm>
#include <stdexcept>

namespace onde::chapter {
namespace {

using glm::dvec2;
using glm::dvec3;

double largest(const dvec3& v) {
    return std::max({v.x, v.y, v.z});
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

/// A ray that a node starts.
struct Tracer::Step {
    dvec3 direction, factor;
    const Wavelength* wavelength;
    bool at_source = false; ///< the reflection of the surface it meets is a factor as well
};

Tracer::Tracer(const Scene& scene, uint32_t depth)
    : scene_(scene), world_(scene), depth_(depth),
      wavelengths_(split_white(scene.chapter.whitted.wavelengths)) {
    if (!scene.textures.empty()) throw std::invalid_argument("textures");
    if (scene.environment.map) throw std::invalid_argument("an environment map");
}

dvec3 Tracer::background() const {
    return dvec3(scene_.chapter.whitted.background.value_or(scene_.environment.radiance));
}

dvec3 Tracer::sum(const dvec3& a, const dvec3& b) const {
    return scene_.chapter.whitted.saturate ? glm::min(a + b, 1.0) : a + b;
}

std::vector<Tracer::Step> Tracer::steps(const Surface& at, const dvec3& view,
                                        const RayHistory& way) const {
    const Material& material = scene_.materials[at.material];
    const Phong phong = phong_of(scene_, at.material);
    const double reflection = double(phong.reflection);
    double transmission = double(phong.transmission);
    const bool transparent = transmission > 0;
    const auto eta = [&](double index) { return at.front ? 1 / index : index; };
    const double index = double(material.ior);
    double mirrored = 0; // what Fresnel's formula takes from the transmitted ray
    if (scene_.chapter.whitted.fresnel && transparent) {
        const double share = fresnel(glm::dot(at.normal, view), eta(index));
        mirrored = transmission * share;
        transmission *= 1 - share;
    }
    const dvec3 reflected = mirror(view, at.normal);
    std::vector<Step> result;
    if (scene_.chapter.whitted.reflectivity == Reflectivity::source)
        result.push_back({reflected,
                          dvec3(scene_.chapter.whitted.fresnel && transparent ? mirrored : 1.0),
                          way.wavelength, true});
    else
        result.push_back({reflected, dvec3(std::min(reflection + mirrored, 1.0)), way.wavelength});
    if (!transparent) return result;
    const auto transmit = [&](double n, const dvec3& filter, const Wavelength* wavelength) {
        const auto refracted = refract(view, at.normal, eta(n));
        way.mark(refracted.has_value());
        result.push_back({refracted.value_or(reflected), transmission * filter, wavelength});
    };
    const double abbe = phong.abbe.value_or(0.0f);
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

dvec3 Tracer::child(const Step& step, const Surface& from, const RayHistory& way) const {
    const Ray ray{from.point, step.direction};
    dvec3 factor = step.factor;
    const double epsilon = double(scene_.chapter.whitted.epsilon);
    if (largest(way.product * factor) <= epsilon) return dvec3(0);
    const auto hit = world_.nearest(ray);
    way.mark(hit ? hit->primitive : 0);
    if (step.at_source && hit) {
        factor *= double(phong_of(scene_, hit->material).reflection);
        const bool counts = largest(way.product * factor) > epsilon;
        way.mark(counts);
        if (!counts) return dvec3(0);
    }
    if (!hit) return factor * background();
    const RayHistory further{way.depth + 1, way.product * factor, step.wavelength, way.sample,
                             way.structure};
    const double falloff = scene_.chapter.whitted.distance_falloff ? hit->t * hit->t : 1;
    return factor * colour(*hit, ray, further) / falloff;
}

dvec3 Tracer::colour(const Surface& at, const Ray& ray, const RayHistory& way) const {
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
    const RayHistory way{1, dvec3(1), nullptr, number, &seen.structure};
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
