// Microfacets distributed as Beckmann's.
#include "kernels/bsdf_rig.h"
#include "upload/microfacet_albedo.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::bsdf;

namespace {

Surface beckmann(Surface surface, double anisotropy = 0) {
    surface.name += fmt::format(", Beckmann, grain {}", anisotropy);
    surface.material.distribution = Distribution::beckmann;
    surface.material.anisotropy = float(anisotropy);
    return surface;
}

/// Smith's Lambda, by the error function itself.
double smith(glm::dvec3 w, glm::dvec2 alpha) {
    const double a = w.z / std::hypot(alpha.x * w.x, alpha.y * w.y);
    return 0.5 * (std::exp(-a * a) / (a * std::sqrt(M_PI)) - std::erfc(a));
}

/// Of white microfacets, times cosine.
double single(glm::dvec3 wo, glm::dvec3 wi, glm::dvec2 alpha) {
    const glm::dvec3 h = glm::normalize(wo + wi);
    const double slope2 = std::pow(h.x / (h.z * alpha.x), 2) + std::pow(h.y / (h.z * alpha.y), 2);
    const double d = std::exp(-slope2) / (M_PI * alpha.x * alpha.y * std::pow(h.z, 4));
    return d / (1 + smith(wo, alpha) + smith(wi, alpha)) / (4 * wo.z);
}

std::vector<Surface> all_kinds() {
    std::vector<Surface> surfaces;
    for (const float alpha : {0.01f, 0.1f, 0.4f, 1.0f}) {
        surfaces.push_back(beckmann(conductor(alpha)));
        surfaces.push_back(beckmann(mix(alpha, 0.0f, glm::vec3(1))));
        surfaces.push_back(beckmann(glass(alpha, 1.5f)));
        surfaces.push_back(beckmann(glass(alpha, 1.5f, false)));
        surfaces.push_back(beckmann(pane(alpha)));
    }
    surfaces.push_back(beckmann(conductor(0.1f), 0.6));
    surfaces.push_back(beckmann(mix(0.3f, 0.5f, glm::vec3(1)), 0.8));
    return surfaces;
}

} // namespace

TEST_CASE("the albedo of Beckmann's microfacets is the sum of what goes anywhere") {
    const Quadrature fine(SphereBins{});
    for (const double alpha : {0.2, 0.5, 1.0})
        for (const double cosine : {0.15, 0.6, 0.98}) {
            const glm::dvec3 wo(direction(cosine, 0.3));
            double sum = 0;
            for (size_t i = 0; i < fine.directions.size(); i++) {
                const glm::dvec3 wi(fine.directions[i]);
                if (wi.z > 1e-6) sum += fine.weights[i] * single(wo, wi, {alpha, alpha});
            }
            INFO("alpha " << alpha << ", cosine " << cosine);
            CHECK(reflection_albedo(cosine, alpha, Distribution::beckmann).white ==
                  Approx(sum).margin(1.5e-3));
        }
}

TEST_CASE("Beckmann's microfacets send light where their slopes say, by values and by samples") {
    Bsdfs bsdfs = on_device(all_kinds());
    constexpr size_t COUNT = 1 << 16;
    uint32_t seed = 1;
    for (const Surface& surface : bsdfs.surfaces()) {
        if (surface.alpha() < 0.05) continue; // too narrow for the quadrature
        for (const double cosine : {0.95, 0.5, 0.12}) {
            INFO(surface.name << ", cosine " << cosine);
            const glm::vec3 wo = direction(cosine, 0.7);
            double total = 0;
            CHECK(distribution_failure(quadrature(), evaluate_sphere(bsdfs, surface, wo).pdf,
                                       sample(bsdfs, surface, wo, COUNT, seed++), 1e-6,
                                       total) == "");
            CHECK(total < 1 + 2e-3);
        }
    }
    Generator generator(3);
    const std::vector<glm::vec3> wi = directions_above(generator, COUNT);
    for (const Surface& surface : bsdfs.surfaces()) {
        if (surface.material.kind != MaterialKind::conductor || surface.alpha() < 0.05) continue;
        const glm::vec3 wo = direction(0.8, 0.9);
        const Column value = evaluate(bsdfs, surface, std::vector(COUNT, wo), wi).value[0];
        const glm::dvec2 alpha = alphas(surface.material);
        // Single reflection, over how much of all light that is.
        const double along = std::abs(double(wo.x)) / std::hypot(double(wo.x), double(wo.y));
        const double kept = beckmann_grain_albedo(double(wo.z), along, alpha.x, alpha.y).white;
        const auto wanted = [&](size_t i) {
            return single(glm::dvec3(wo), glm::dvec3(wi[i]), alpha) / kept;
        };
        INFO(surface.name);
        CHECK(worst_ratio(value, wanted, 0.02, 1e-3) == "");
    }
}

TEST_CASE("white surfaces of Beckmann's microfacets return about all light, from wherever it "
          "comes") {
    Bsdfs bsdfs = on_device(all_kinds());
    for (const Surface& surface : bsdfs.surfaces())
        for (const double cosine : {1.0, 0.6, 0.25, 0.1}) {
            INFO(surface.name << ", cosine " << cosine);
            const MeanWeight mean =
                mean_weight(surface, sample(bsdfs, surface, direction(cosine, 0.8), 1 << 14, 9));
            CHECK(mean.value.x > 0.985 - 4 * mean.deviation.x);
            CHECK(mean.value.x < 1 + 1e-5 + 4 * mean.deviation.x);
        }
}

TEST_CASE("Beckmann's highlights have no tails") {
    Bsdfs bsdfs = on_device({conductor(0.1f), beckmann(conductor(0.1f))});
    const glm::vec3 up(0, 0, 1);
    const std::vector<glm::vec3> wi{direction(1 - 1e-6, 0), direction(std::cos(1.0), 0)};
    const std::vector<glm::vec3> wo(wi.size(), up);
    const Column ggx = evaluate(bsdfs, bsdfs.surfaces()[0], wo, wi).value[0];
    const Column beckmann = evaluate(bsdfs, bsdfs.surfaces()[1], wo, wi).value[0];
    CHECK(beckmann[0] == Approx(ggx[0]).epsilon(0.02));
    CHECK(beckmann[1] < 1e-6f * ggx[1]);
}
