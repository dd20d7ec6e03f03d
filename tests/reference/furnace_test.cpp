// The white furnace: whatever only redirects light is invisible in front of radiance 1.
#include "support/reference/reference.h"
#include "support/reference/scenes.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::reference;

namespace {

ReferenceResult render(const Scene& scene, uint32_t samples, uint32_t depth = 32,
                       uint32_t roulette_start = 4) {
    ReferenceOptions options;
    options.roulette_start = roulette_start;
    options.width = options.height = 16;
    options.samples = samples;
    options.depth = depth;
    return ReferenceRenderer(scene).render(options);
}

/// Every channel of every pixel within 4 standard deviations (or rounding) of 1.
void check_white(const ReferenceResult& result) {
    for (size_t i = 0; i < result.mean.size(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            const float bound = 4.0f * std::sqrt(result.variance_of_mean[i][c]) + 1e-4f;
            INFO("pixel " << i << ", channel " << c << ", bound " << bound);
            CHECK(std::abs(result.mean[i][c] - 1.0f) < bound);
        }
    CHECK(result.invalid_samples == 0);
}

/// The whole picture keeps 0.99 to 1 of the light, to some thousandths for tables of albedos and
/// 4 standard deviations.
void check_conserved(const ReferenceResult& result) {
    const auto count = double(result.mean.size());
    double sum = 0.0, variance = 0.0;
    for (size_t i = 0; i < result.mean.size(); ++i) {
        sum += double(result.mean[i].x);
        variance += double(result.variance_of_mean[i].x);
    }
    const double mean = sum / count, deviation = std::sqrt(variance) / count;
    INFO("mean " << mean << ", deviation " << deviation);
    CHECK(deviation < 0.004);
    CHECK(mean > 0.99 - 4.0 * deviation);
    CHECK(mean < 1.003 + 4.0 * deviation);
    CHECK(result.invalid_samples == 0);
}

} // namespace

TEST_CASE("a white diffuse sphere vanishes in the furnace") {
    check_white(render(furnace(diffuse(glm::vec3(1.0f))), 512));
}

TEST_CASE("smooth glass without tint vanishes in the furnace") {
    check_white(render(furnace(glass(1.5f, 0.0f)), 256, 128));
}

TEST_CASE("a diamond with an air sphere inside vanishes in the furnace") {
    Scene scene = furnace(glass(2.4f, 0.0f));
    scene.materials.push_back(glass(1.0f / 2.4f, 0.0f));
    scene.spheres.push_back({{0.1f, 0.0f, 0.0f}, 0.6f, 1});
    check_white(render(scene, 64, 10000, 10000));
}

TEST_CASE("a smooth white mirror vanishes in the furnace") {
    check_white(render(furnace(conductor(glm::vec3(1.0f), 0.0f)), 64));
}

TEST_CASE("white metal returns all light, however rough") {
    for (const float roughness : {0.1f, 0.4f, 0.7f, 1.0f}) {
        INFO("roughness " << roughness);
        check_conserved(render(furnace(conductor(glm::vec3(1.0f), roughness)), 1024));
    }
}

TEST_CASE("clear glass passes on all light, however rough") {
    for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
        INFO("roughness " << roughness);
        check_conserved(render(furnace(glass(1.5f, roughness)), 1024, 128));
    }
}

TEST_CASE("a white body below a coat, a white metal and their mixes return all light") {
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float roughness : {0.0f, 0.3f, 1.0f}) {
            Material material = diffuse(glm::vec3(1.0f));
            material.kind = MaterialKind::metallic_roughness;
            material.metallic = metallic;
            material.roughness = roughness;
            INFO("metallic " << metallic << ", roughness " << roughness);
            check_conserved(render(furnace(material), 1024));
        }
}
