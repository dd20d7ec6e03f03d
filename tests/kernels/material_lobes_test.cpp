// Which lobes a material has, and how one is chosen.
#include "kernels/scene_probe.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

TEST_CASE(
    "a material's lobes are those of its kind, chosen with probabilities that add up to one") {
    constexpr size_t COUNT = 1 << 10;
    Generator generator(77);
    Scene scene = scene_with_a_speck();
    scene.materials.resize(COUNT);
    Columns in(3);
    for (size_t i = 0; i < COUNT; i++) {
        Material& material = scene.materials[i];
        material.kind = MaterialKind(i % 4);
        material.base_color = glm::vec3(unit(generator), unit(generator), unit(generator));
        material.roughness = unit(generator);
        material.metallic = i % 3 == 0 ? 0.0f : unit(generator);
        in[0].push_back(word(uint32_t(i)));
        in[1].push_back(float(i / 4 % 2));
        in[2].push_back(0.01f + 0.99f * unit(generator));
    }
    const Columns out = SceneProbe(scene, {"material"}).run("material", in, 2 * LOBE_COUNT);
    const uint32_t kinds[LOBE_COUNT] = {
#define KINDS_OF_LOBE(NAME, name, Type, transmits, kinds) kinds,
        LOBES(KINDS_OF_LOBE)
#undef KINDS_OF_LOBE
    };
    uint32_t seen = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double sum = 0;
        for (size_t k = 0; k < LOBE_COUNT; k++) {
            const bool has = kinds[k] >> i % 4 & 1;
            REQUIRE(out[LOBE_COUNT + k][i] == float(has));
            REQUIRE(out[k][i] >= 0);
            if (!has) REQUIRE(out[k][i] == 0);
            seen |= uint32_t(has) << k;
            sum += double(out[k][i]);
        }
        REQUIRE(sum == Approx(1).epsilon(1e-6));
    }
    CHECK(seen == (1u << LOBE_COUNT) - 1);
}
