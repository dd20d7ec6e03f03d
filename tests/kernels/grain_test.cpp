// Microfacets with a grain (KHR_materials_anisotropy).
#include "kernels/bsdf_rig.h"
#include "upload/microfacet_albedo.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::bsdf;

namespace {

Surface brushed(double roughness, double strength, double metallic = 1,
                glm::vec3 color = glm::vec3(1)) {
    Surface surface = mix(float(roughness * roughness), float(metallic), color);
    surface.name += fmt::format(", grain {}", strength);
    surface.material.anisotropy = float(strength);
    return surface;
}

double stretched(glm::dvec3 w, glm::dvec2 alpha) {
    return std::hypot(alpha.x * w.x, alpha.y * w.y) / w.z;
}
double smith(glm::dvec3 w, glm::dvec2 alpha) {
    return 0.5 * (std::sqrt(1 + std::pow(stretched(w, alpha), 2)) - 1);
}

/// Of white microfacets, times cosine; Burley's distribution and Heitz' shadowing.
double single(glm::dvec3 wo, glm::dvec3 wi, glm::dvec2 alpha) {
    const glm::dvec3 h = glm::normalize(wo + wi);
    const double s = std::pow(h.x / alpha.x, 2) + std::pow(h.y / alpha.y, 2) + h.z * h.z;
    const double d = 1 / (M_PI * alpha.x * alpha.y * s * s);
    return d / (1 + smith(wo, alpha) + smith(wi, alpha)) / (4 * wo.z);
}

} // namespace

TEST_CASE("the albedo with a grain is the sum of what goes anywhere, and that without where there "
          "is none") {
    for (const double alpha : {0.05, 0.4, 1.0})
        for (const double cosine : {0.1, 0.5, 1.0}) {
            const ReflectionAlbedo plain = reflection_albedo(cosine, alpha);
            const ReflectionAlbedo same = grain_albedo(cosine, 0.3, alpha, alpha);
            CHECK(same.white == Approx(plain.white).margin(2e-3));
            CHECK(same.grazing == Approx(plain.grazing).margin(2e-3));
        }
    const Quadrature fine(SphereBins{});
    for (const double along : {0.0, 0.7, 1.0}) {
        const glm::dvec3 wo(direction(0.6, std::acos(along)));
        double sum = 0;
        for (size_t i = 0; i < fine.directions.size(); i++) {
            const glm::dvec3 wi(fine.directions[i]);
            if (wi.z > 1e-6) sum += fine.weights[i] * single(wo, wi, {0.8, 0.3});
        }
        CHECK(grain_albedo(0.6, along, 0.8, 0.3).white == Approx(sum).margin(3e-3));
    }
}

TEST_CASE("what a grain reflects goes where its alphas say, by values and by samples") {
    Bsdfs bsdfs = on_device({brushed(0.4, 0.5), brushed(0.5, 0.9), brushed(0.7, 0.3),
                             brushed(0.5, 0.7, 0.4, {0.9f, 0.5f, 0.2f})});
    constexpr size_t COUNT = 1 << 16;
    uint32_t seed = 1;
    for (const Surface& surface : bsdfs.surfaces())
        for (const double azimuth : {0.0, 0.6, 1.5, 2.8}) {
            const glm::vec3 wo = direction(0.55, azimuth);
            INFO(surface.name << ", azimuth " << azimuth);
            double total = 0;
            CHECK(distribution_failure(quadrature(), evaluate_sphere(bsdfs, surface, wo).pdf,
                                       sample(bsdfs, surface, wo, COUNT, seed++), 1e-6,
                                       total) == "");
            CHECK(total < 1 + 1e-3);
        }
    Generator generator(3);
    const std::vector<glm::vec3> wi = directions_above(generator, COUNT);
    const Surface& surface = bsdfs.surfaces()[0];
    const glm::vec3 wo = direction(0.8, 0.9);
    const Column value = evaluate(bsdfs, surface, std::vector(COUNT, wo), wi).value[0];
    const glm::dvec2 alpha = alphas(surface.material);
    // Single reflection, over how much of all light that is.
    const double along = std::abs(double(wo.x)) / std::hypot(double(wo.x), double(wo.y));
    const double kept = grain_albedo(double(wo.z), along, alpha.x, alpha.y).white;
    const auto wanted = [&](size_t i) {
        return single(glm::dvec3(wo), glm::dvec3(wi[i]), alpha) / kept;
    };
    CHECK(worst_ratio(value, wanted, 0.02, 1e-3) == "");
}

TEST_CASE("white metal with a grain returns about all light, from wherever it comes") {
    std::vector<Surface> surfaces;
    for (const double roughness : {0.0, 0.2, 0.45, 0.8, 1.0})
        for (const double strength : {0.15, 0.4, 0.7, 1.0})
            surfaces.push_back(brushed(roughness, strength));
    surfaces.push_back(brushed(0.3, 0.6, 0));
    surfaces.push_back(brushed(0.3, 0.6, 0.5));
    Bsdfs bsdfs = on_device(std::move(surfaces));
    for (const Surface& surface : bsdfs.surfaces())
        for (const double cosine : {1.0, 0.6, 0.25, 0.1})
            for (const double azimuth : {0.0, 0.8, 1.3, M_PI / 2}) {
                INFO(surface.name << ", cosine " << cosine << ", azimuth " << azimuth);
                const MeanWeight mean = mean_weight(
                    surface, sample(bsdfs, surface, direction(cosine, azimuth), 1 << 14, 9));
                CHECK(mean.value.x > 0.985 - 4 * mean.deviation.x);
                CHECK(mean.value.x < 1 + 1e-5 + 4 * mean.deviation.x);
            }
}
