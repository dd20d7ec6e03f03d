// BSDF lobes: samples against densities, weights against values, values against formulas.
#include "doctor/bsdf_rig.h"
#include "doctor/checks.h"
#include "doctor/exact.h"
#include "doctor/tally.h"
#include "gpu/settings.h"

namespace onde::doctor {

namespace {

using namespace bsdf;

std::vector<Surface> surfaces() {
    return {diffuse(),
            conductor(0.16f),
            conductor(0.6f),
            mix(0.5f, 0.5f),
            mix(0.9f, 0.0f),
            glass(0.2f, 1.5f),
            glass(0.5f, 1.5f, false),
            glass(0, 1.5f),
            glass(0, 1.5f, false),
            pane(0.4f),
            clear_mix(0.3f, 0.2f, 0.6f, true)};
}

/// What a check of one surface, seen from one direction, goes by.
struct Case {
    Bsdfs& bsdfs;
    const Quadrature& over;
    const Surface& surface;
    glm::vec3 wo;

    std::string name() const {
        return fmt::format("{}, seen with a cosine of {:.1f}", surface.name, wo.z);
    }
};

void check_samples(Tally& tally, const Case& c, size_t count, uint32_t seed) {
    const Column pdf = evaluate_sphere(c.bsdfs, c.over, c.surface, c.wo).pdf;
    const Samples samples = sample(c.bsdfs, c.surface, c.wo, count, seed);
    double total = 0;
    tally.expect_none(distribution_failure(c.over, pdf, samples, 1e-6, total), c.name());
    // Of the others a part lies below the horizon, where nothing is sampled.
    const bool whole = c.surface.material.kind == MaterialKind::diffuse;
    tally.expect_near(total, whole ? 1.0 : std::min(total, 1.0), whole ? 1e-4 : 2e-3,
                      c.name() + ": the integral of the density");
    const Values values = evaluate(c.bsdfs, c.surface, std::vector(count, c.wo), samples.wi);
    for (size_t i = 0; i < count; i++) {
        if (samples.valid[i] == 0) continue;
        tally.expect_near(samples.pdf[i] / values.pdf[i], 1, 1e-4,
                          "the density of a sample over that of its direction");
        const double wanted = values.value[0][i] / values.pdf[i];
        tally.expect_near(samples.weight[i].x, wanted, 1e-4 * std::max(wanted, 1e-3),
                          "the weight of a sample");
    }
}

/// Opaque surfaces in double precision.
void check_values(Tally& tally, Bsdfs& bsdfs, const Surface& surface, size_t count) {
    Generator generator(2);
    const std::vector<glm::vec3> wo = directions_above(generator, count);
    const std::vector<glm::vec3> wi = directions_above(generator, count);
    const Columns value = evaluate(bsdfs, surface, wo, wi).value;
    const OpaqueValue exact(surface, bsdfs.packed().albedos);
    for (uint32_t k = 0; k < 3; k++)
        for (size_t i = 0; i < count; i++) {
            const double wanted = exact(glm::dvec3(wo[i]), glm::dvec3(wi[i]))[k];
            tally.expect_near(value[k][i], wanted, 1e-4 * std::max(wanted, 1e-6),
                              surface.name + ": a value");
        }
}

/// What is white returns all light, but for the tables' steps.
void check_energy(Tally& tally, const Case& c) {
    const Column value = evaluate_sphere(c.bsdfs, c.over, c.surface, c.wo).value[0];
    const double eta2 = c.surface.is_glass() ? c.surface.eta() * c.surface.eta() : 1.0;
    const double albedo =
        integrate(c.over, value, [&](glm::vec3 wi) { return wi.z < 0 ? eta2 : 1.0; });
    tally.expect_near(albedo, 1, 0.01, c.name() + ": its albedo");
}

/// Smooth glass refracts by Snell's law, and as often as Fresnel's equations say.
void check_smooth_glass(Tally& tally, const Case& c, size_t count) {
    const glm::vec3 wo = c.wo;
    const auto eta = float(c.surface.eta());
    const Samples samples = sample(c.bsdfs, c.surface, wo, count, 7);
    size_t reflected = 0;
    for (size_t i = 0; i < count; i++) {
        const glm::vec3 wi = samples.wi[i];
        const bool above = wi.z > 0;
        reflected += above;
        const glm::vec3 mirrored(-wo.x, -wo.y, wo.z);
        const double off =
            above ? glm::length(wi - mirrored) : glm::length(glm::vec2(wi) + glm::vec2(wo) / eta);
        tally.expect_near(off, 0, 2e-6, "a direction of smooth glass is off by this, which");
        tally.expect_near(samples.weight[i].x, above ? 1.0 : 1.0 / (double(eta) * eta), 2e-6,
                          "a weight of smooth glass");
    }
    const double wanted = reflectance(wo.z, eta);
    const double deviation = std::sqrt(wanted * (1 - wanted) / double(count));
    tally.expect_near(double(reflected) / double(count), wanted, 5 * deviation + 1e-6,
                      "the share that smooth glass reflects");
}

} // namespace

Finding check_lobes(const CheckContext& context) {
    Bsdfs bsdfs(context.programs, surfaces(), gpu::default_settings(context.facts()).width);
    const Quadrature over({.polar = 24, .around = 16});
    const size_t count = context.quick ? 1 << 13 : 1 << 15;
    Tally tally;
    uint32_t seed = 1;
    for (const Surface& surface : bsdfs.surfaces()) {
        const bool smooth = surface.material.roughness == 0;
        for (const glm::vec3 wo : outgoing()) {
            const Case c{bsdfs, over, surface, wo};
            if (smooth) {
                check_smooth_glass(tally, c, count / 8);
                continue;
            }
            check_samples(tally, c, count, seed++);
            if (surface.material.base_color == glm::vec3(1)) check_energy(tally, c);
        }
        if (!surface.is_glass()) check_values(tally, bsdfs, surface, count / 8);
    }
    return tally.finding("tests fail");
}

} // namespace onde::doctor
