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

} // namespace onde::test::bsdf
