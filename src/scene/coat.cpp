#include "scene/coat.h"

#include <algorithm>
#include <cmath>

namespace onde {

/// Of unpolarized light that meets a dielectric from outside.
static double fresnel(double cosine, double index) {
    const double sine2 = (1.0 - cosine * cosine) / (index * index);
    const double inside = std::sqrt(std::max(1.0 - sine2, 0.0));
    const double s = (cosine - index * inside) / (cosine + index * inside);
    const double p = (inside - index * cosine) / (inside + index * cosine);
    return 0.5 * (s * s + p * p);
}

/// What is sent back outside is 2 F(mu) mu dmu; by reciprocity, what comes out of diffuse light
/// from within is what goes in, over the square of the index.
double internal_reflectance(double index) {
    constexpr int STEPS = 256;
    double outside = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        const double cosine = (i + 0.5) / STEPS;
        outside += 2.0 * cosine * fresnel(cosine, index) / STEPS;
    }
    return 1.0 - (1.0 - outside) / (index * index);
}

glm::vec3 coated_albedo(const glm::vec3& albedo, double index) {
    const glm::dvec3 body = glm::clamp(glm::dvec3(albedo), 0.0, 1.0);
    const double back = std::clamp(internal_reflectance(std::max(index, 1.0)), 0.0, 0.999);
    return glm::vec3(body * (1.0 - back) / (1.0 - body * back));
}

} // namespace onde
