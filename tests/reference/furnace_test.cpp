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

double mean_luminance(const ReferenceResult& result) {
    double sum = 0.0;
    for (const glm::vec3& pixel : result.mean) sum += double(pixel.x + pixel.y + pixel.z) / 3.0;
    return sum / double(result.mean.size());
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

TEST_CASE("a rough conductor loses light to masking and never gains any") {
    double previous = 1.002;
    for (const float roughness : {0.1f, 0.4f, 0.7f, 1.0f}) {
        const ReferenceResult result = render(furnace(conductor(glm::vec3(1.0f), roughness)), 256);
        for (size_t i = 0; i < result.mean.size(); ++i)
            CHECK(result.mean[i].x < 1.0f + 4.0f * std::sqrt(result.variance_of_mean[i].x) + 1e-4f);
        INFO("roughness " << roughness);
        CHECK(mean_luminance(result) < previous);
        previous = mean_luminance(result) + 1e-4;
    }
    CHECK(previous > 0.3);
}

TEST_CASE(
    "rough glass passes on nearly everything when its roughness is low, never more than all") {
    for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
        const ReferenceResult result = render(furnace(glass(1.5f, roughness)), 512, 128);
        INFO("roughness " << roughness);
        CHECK(mean_luminance(result) < 1.005);
        CHECK(mean_luminance(result) > (roughness < 0.2f ? 0.99 : 0.3));
    }
}

// The glTF mix weighs its diffuse lobe by the Fresnel term of the half vector, which is not exactly
// what the specular lobe takes: at grazing angles it may gain some percent.
TEST_CASE("the glTF mix keeps the furnace's energy but for a few percent") {
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float roughness : {0.0f, 0.3f, 1.0f}) {
            Material material = diffuse(glm::vec3(1.0f));
            material.kind = MaterialKind::metallic_roughness;
            material.metallic = metallic;
            material.roughness = roughness;
            const double mean = mean_luminance(render(furnace(material), 256));
            INFO("metallic " << metallic << ", roughness " << roughness);
            CHECK(mean < 1.03);
            CHECK(mean > 0.3);
        }
}
