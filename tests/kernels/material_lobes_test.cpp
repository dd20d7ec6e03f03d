// Which lobes a material has, and how one is chosen.
#include "doctor/mapped_bsdfs.h"
#include "kernels/bsdf_rig.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::bsdf;

TEST_CASE(
    "a material's lobes are those of its kind, chosen with probabilities that add up to one") {
    constexpr size_t COUNT = 1 << 10;
    Generator generator(77);
    std::vector<Surface> surfaces(COUNT);
    Columns in(5);
    for (size_t i = 0; i < COUNT; i++) {
        surfaces[i].material = doctor::mixed_material(generator);
        surfaces[i].material.ior = 1.5f; // a table for each would take long
        in[0].push_back(word(uint32_t(i)));
        in[1].push_back(float(i / 4 % 2));
        for (size_t k = 2; k < 4; k++) in[k].push_back(0);
        in[4].push_back(0.01f + 0.99f * unit(generator));
    }
    const Columns out = on_device(surfaces).probe().run("bsdf_lobes", in, 2 * LOBE_COUNT);
    uint32_t seen = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double sum = 0;
        for (size_t k = 0; k < LOBE_COUNT; k++) {
            const bool has = lobes_of(surfaces[i].material) >> k & 1;
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
