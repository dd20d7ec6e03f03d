// Smooth lobes, which have one direction and no density.
#include "kernels/bsdf_rig.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::bsdf;

TEST_CASE("a smooth conductor mirrors, and its weight is its reflectance") {
    Bsdfs bsdfs = on_device({conductor(0, 0.5f)});
    for (glm::vec3 wo : outgoing()) {
        const Samples samples = sample(bsdfs, bsdfs.surfaces()[0], wo, 64, 6);
        const double wanted = 0.5 + 0.5 * std::pow(1 - double(wo.z), 5);
        for (size_t i = 0; i < samples.wi.size(); i++) {
            REQUIRE((samples.delta[i] != 0 && samples.valid[i] != 0 && samples.pdf[i] == 0));
            REQUIRE(samples.wi[i] == glm::vec3(-wo.x, -wo.y, wo.z));
            REQUIRE(samples.weight[i].x == Approx(wanted).epsilon(1e-6));
        }
    }
}

TEST_CASE("smooth glass reflects by Fresnel's probability and refracts by Snell's law") {
    constexpr size_t COUNT = 1 << 14;
    Bsdfs bsdfs = on_device({glass(0, 1.5f), glass(0, 1.5f, false)});
    for (const Surface& surface : bsdfs.surfaces())
        for (glm::vec3 wo : outgoing()) {
            INFO(surface.name << ", cosine " << wo.z);
            const auto eta = float(surface.eta());
            const Samples samples = sample(bsdfs, surface, wo, COUNT, 7);
            size_t reflected = 0;
            for (size_t i = 0; i < COUNT; i++) {
                REQUIRE((samples.delta[i] != 0 && samples.valid[i] != 0));
                const glm::vec3 wi = samples.wi[i];
                if (wi.z > 0) {
                    reflected++;
                    REQUIRE(glm::length(wi - glm::vec3(-wo.x, -wo.y, wo.z)) < 1e-6f);
                    REQUIRE(samples.weight[i].x == 1.0f);
                } else {
                    REQUIRE(glm::length(glm::vec2(wi) + glm::vec2(wo) / eta) < 1e-6f);
                    REQUIRE(glm::length(wi) == Approx(1).epsilon(1e-6));
                    REQUIRE(samples.weight[i].x == Approx(1 / (eta * eta)).epsilon(1e-6));
                }
            }
            const double sine2 = (1 - double(wo.z) * double(wo.z)) / (double(eta) * double(eta));
            const double in = std::sqrt(std::max(1 - sine2, 0.0)), out = wo.z;
            const double p = (eta * out - in) / (eta * out + in);
            const double s = (out - eta * in) / (out + eta * in);
            const double wanted = sine2 >= 1 ? 1 : (p * p + s * s) / 2;
            const double deviation = std::sqrt(wanted * (1 - wanted) / COUNT);
            CHECK(double(reflected) / COUNT == Approx(wanted).margin(5 * deviation + 1e-6));
        }
}

TEST_CASE("delta lobes have no value and no pdf") {
    Bsdfs bsdfs = on_device({conductor(0), glass(0, 1.5f)});
    for (const Surface& surface : bsdfs.surfaces()) {
        const Values values = evaluate_sphere(bsdfs, surface, outgoing()[1]);
        CHECK(integrate(values.value[0]) == 0);
        CHECK(integrate(values.pdf) == 0);
    }
}

TEST_CASE("a smooth mix samples its diffuse lobe by the pdf of that lobe alone") {
    Bsdfs bsdfs = on_device({mix(0, 0)});
    const Surface& surface = bsdfs.surfaces()[0];
    const glm::vec3 wo = outgoing()[1];
    Columns in = columns_of(surface, 1);
    add_vectors(in, {wo});
    const double mirrors = bsdfs.probe().run("bsdf_lobes", in, 2 * LOBE_COUNT)[LOBE_GLOSSY][0];
    CHECK(mirrors > 0.02);
    CHECK(mirrors < 0.5);
    const Values values = evaluate_sphere(bsdfs, surface, wo);
    CHECK(integrate(values.pdf) == Approx(1 - mirrors).epsilon(1e-5));
    const Samples samples = sample(bsdfs, surface, wo, 1 << 14, 8);
    double sum = 0, deltas = 0;
    for (size_t i = 0; i < samples.wi.size(); i++) {
        sum += samples.delta[i] != 0 ? 0.0 : double(samples.weight[i].x);
        deltas += samples.delta[i];
    }
    const double count = double(samples.wi.size());
    CHECK(deltas / count == Approx(mirrors).margin(5 * 0.5 / std::sqrt(count)));
    // Weights are at most 1 / (1 - mirrors).
    CHECK(sum / count ==
          Approx(integrate(values.value[0])).margin(5 / (1 - mirrors) / std::sqrt(count)));
}
