// Light sampling, BSDF sampling and their combination are estimators of the same integral.
#include "support/reference/compare.h"
#include "support/reference/scenes.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::reference;

namespace {

ReferenceResult render(const Scene& scene, Technique technique, uint32_t samples) {
    ReferenceOptions options;
    options.samples = samples;
    options.depth = 4;
    options.seed = uint32_t(technique);
    options.technique = technique;
    return ReferenceRenderer(scene).render(options);
}

Image image_of(const ReferenceResult& result) {
    Image image(result.width, result.height, 3);
    for (size_t i = 0; i < result.mean.size(); ++i)
        for (size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = result.mean[i][c];
    return image;
}

/// Each technique has its own variance, so the comparison counts both.
void check_same_mean(const Scene& scene, Technique other) {
    ReferenceResult mis = render(scene, Technique::mis, 64);
    const ReferenceResult single = render(scene, other, 128);
    for (size_t i = 0; i < mis.mean.size(); ++i)
        mis.variance_of_mean[i] += single.variance_of_mean[i];
    const Comparison c = compare_to_reference(image_of(single), 1u << 30, mis);
    INFO(c.sentence);
    CHECK(c.accepted);
}

Material mix(float metallic, float roughness) {
    Material m = diffuse({0.8f, 0.6f, 0.3f});
    m.kind = MaterialKind::metallic_roughness;
    m.metallic = metallic;
    m.roughness = roughness;
    return m;
}

Scene lit_by_everything(const Material& material) {
    Scene scene = box_room(material);
    scene.materials.push_back(emitter({1.0f, 2.0f, 3.0f}));
    scene.spheres.push_back({{-0.5f, -0.7f, 0.4f}, 0.2f, 5});
    Image map(8, 4, 3);
    for (size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] = float(i * 37 % 11) / 10.0f;
    scene.environment = {glm::vec3(0.5f), map, 1.0f};
    return scene;
}

} // namespace

TEST_CASE("light sampling alone agrees with multiple importance sampling") {
    for (const Material& material : {diffuse(glm::vec3(0.5f)), conductor(glm::vec3(0.9f), 0.4f),
                                     glass(1.5f, 0.5f), mix(0.5f, 0.4f), mix(0.0f, 0.0f)})
        check_same_mean(lit_by_everything(material), Technique::light_only);
}

TEST_CASE("BSDF sampling alone agrees with multiple importance sampling") {
    for (const Material& material : {diffuse(glm::vec3(0.5f)), conductor(glm::vec3(0.9f), 0.4f),
                                     glass(1.5f, 0.5f), mix(0.5f, 0.4f), mix(0.0f, 0.0f)})
        check_same_mean(lit_by_everything(material), Technique::bsdf_only);
}

TEST_CASE("multiple importance sampling has less variance than either technique") {
    const Scene scene = lit_by_everything(mix(1.0f, 0.2f));
    const auto total = [&](Technique technique) {
        double sum = 0.0;
        for (const glm::vec3& v : render(scene, technique, 64).variance_of_mean) sum += double(v.y);
        return sum;
    };
    const double mis = total(Technique::mis);
    CHECK(mis < total(Technique::light_only));
    CHECK(mis < total(Technique::bsdf_only));
}
