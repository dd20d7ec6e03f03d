// BSDFs on the tests' device: evaluated, sampled, integrated over the sphere.
#pragma once

#include "doctor/bsdf_rig.h"
#include "kernels/columns.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

namespace onde::test::bsdf {

using namespace doctor::bsdf;

/// Surfaces on the tests' device.
inline Bsdfs on_device(std::vector<Surface> surfaces) {
    return Bsdfs(programs(), std::move(surfaces), 1);
}

inline const Quadrature& quadrature() {
    static const Quadrature built;
    return built;
}

inline Values evaluate_sphere(Bsdfs& bsdfs, const Surface& surface, glm::vec3 wo) {
    return evaluate_sphere(bsdfs, quadrature(), surface, wo);
}

/// The integral over the sphere of a column that `weigh(direction)` scales.
template <class Weigh>
double integrate(const Column& column, const Weigh& weigh) {
    return integrate(quadrature(), column, weigh);
}
inline double integrate(const Column& column) {
    return integrate(column, [](glm::vec3) { return 1.0; });
}

/// A local direction, by the cosine of its polar angle and its azimuth in radians.
inline glm::vec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

/// Of its microfacets, along the grain and across.
inline glm::dvec2 alphas(const Material& m) {
    const double across = std::max(double(m.roughness) * double(m.roughness), 1e-3);
    return {across + (1 - across) * double(m.anisotropy) * double(m.anisotropy), across};
}

/// The mean weight of samples by channel, and its standard deviation: what a surface returns of
/// white light. What is refracted is compressed by eta^2, which is no loss.
struct MeanWeight {
    glm::dvec3 value{0.0}, deviation{0.0};
};
inline MeanWeight mean_weight(const Surface& surface, const Samples& samples) {
    const auto count = double(samples.weight.size());
    glm::dvec3 sum(0), squares(0);
    for (size_t i = 0; i < samples.weight.size(); i++) {
        if (samples.valid[i] == 0) continue;
        const double eta2 = samples.wi[i].z < 0 ? std::pow(surface.eta(), 2) : 1;
        const glm::dvec3 weight = glm::dvec3(samples.weight[i]) * eta2;
        sum += weight / count;
        squares += weight * weight / count;
    }
    return {sum, glm::sqrt(glm::max(squares - sum * sum, 0.0) / count)};
}

} // namespace onde::test::bsdf
