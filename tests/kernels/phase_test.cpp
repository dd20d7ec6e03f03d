// Henyey and Greenstein's phase function on the device.
#include "kernels/columns.h"
#include "kernels/statistics.h"
#include "support/probe.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

TEST_CASE("light is scattered as the phase function says, about the way it came") {
    constexpr size_t COUNT = 1 << 17;
    Probe probe("basics.cl", 1, {"phase"});
    const glm::vec3 on = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    for (const float g : {0.0f, 0.3f, -0.7f, 0.9f}) {
        INFO("anisotropy " << g);
        Generator generator(uint32_t(100 + 10 * g));
        Columns in;
        add_vectors(in, std::vector<glm::vec3>(COUNT, on));
        in.push_back(constant_column(COUNT, g));
        for (int k = 0; k < 2; k++) in.push_back(uniform_column(generator, COUNT));
        const Columns out = probe.run("phase", in, 4);
        double cosines = 0;
        std::vector<double> observed(40, 0.0), expected(40, 0.0);
        const auto bin_of = [](double cosine) {
            return std::min(size_t((1 + cosine) * 20), size_t(39));
        };
        for (size_t i = 0; i < COUNT; i++) {
            const double cosine = glm::dot(glm::dvec3(vector_at(out, 0, i)), glm::dvec3(on));
            cosines += cosine;
            observed[bin_of(cosine)]++;
            const double wanted = (1 - double(g) * g) /
                                  (4 * M_PI * std::pow(1 + double(g) * g - 2 * g * cosine, 1.5));
            if (i % 1024 == 0) CHECK(out[3][i] == Approx(wanted).epsilon(2e-3));
        }
        // Its integral over the cosine, between the bins' edges.
        const auto below = [&](double cosine) {
            if (g == 0) return 0.5 * (1 + cosine);
            return (1 - double(g) * g) / (2 * double(g)) *
                   (1 / std::sqrt(1 + double(g) * g - 2 * g * cosine) - 1 / (1 + double(g)));
        };
        for (size_t k = 0; k < 40; k++)
            expected[k] =
                double(COUNT) * (below(-1 + double(k + 1) / 20) - below(-1 + double(k) / 20));
        CHECK(chi_square_failure(observed, expected, 1e-6) == "");
        CHECK(cosines / COUNT == Approx(g).margin(0.01));
    }
}
