// BSDFs on the tests' device: evaluated, sampled, integrated over the sphere.
#pragma once

#include "doctor/bsdf_rig.h"
#include "kernels/columns.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

namespace onde::test::bsdf {

using namespace doctor::bsdf;

inline doctor::Probe& probe() {
    static Probe built("bsdf.cl", 1, {"bsdf_eval", "bsdf_sample"});
    return built.own();
}

inline Values evaluate(const Surface& surface, const std::vector<glm::vec3>& wo,
                       const std::vector<glm::vec3>& wi) {
    return evaluate(probe(), surface, wo, wi);
}

inline Samples sample(const Surface& surface, glm::vec3 wo, size_t count, uint32_t seed) {
    return sample(probe(), surface, wo, count, seed);
}

inline const Quadrature& quadrature() {
    static const Quadrature built;
    return built;
}

inline Values evaluate_sphere(const Surface& surface, glm::vec3 wo) {
    return evaluate_sphere(probe(), quadrature(), surface, wo);
}

/// The integral over the sphere of a column that `weigh(direction)` scales.
template <class Weigh>
double integrate(const Column& column, const Weigh& weigh) {
    return integrate(quadrature(), column, weigh);
}
inline double integrate(const Column& column) {
    return integrate(column, [](glm::vec3) { return 1.0; });
}

} // namespace onde::test::bsdf
