// Every SIMD lane computes what one alone does, bit for bit.
#include "doctor/checks.h"
#include "doctor/mapped_bsdfs.h"
#include "doctor/tally.h"

namespace onde::doctor {

namespace {

constexpr size_t COUNT = 4096;

void check_masks(Tally& tally, gpu::Programs& programs, uint32_t width) {
    Generator generator(41);
    const Column values = uniform_column(generator, COUNT);
    const Column condition = random_condition(generator, COUNT);
    Columns in{values, condition, Column(COUNT)};
    for (float& index : in[2]) index = word(uint32_t(generator()) % COUNT);
    Probe probe(programs, "basics.cl", width, {"lanes", "compress"});
    const Columns out = probe.run("lanes", in, 4);
    const Column packed = probe.run("compress", {values, condition}, 1)[0];
    Column wanted(COUNT, UNWRITTEN);
    for (size_t i = 0, next = 0; i < COUNT; i++) {
        if (i % width == 0) next = i;
        if (condition[i] != 0) wanted[next++] = values[i];
    }
    for (size_t i = 0; i < COUNT; i++) {
        const uint32_t bits = bits_of_group(condition, i, width);
        const bool right = from_word(out[0][i]) == bits && out[1][i] == condition[i] &&
                           out[2][i] == (bits ? 1.0f : 0.0f) &&
                           out[3][i] == values[from_word(in[2][i])] && packed[i] == wanted[i];
        tally.expect(right, [&] {
            return fmt::format("mask, gather or compressed store of item {} at width {}", i, width);
        });
    }
}

void check_functions(Tally& tally, gpu::Programs& programs, uint32_t width) {
    const std::vector<Mapped> functions = mapped_basics(COUNT);
    std::vector<std::string> names;
    for (const Mapped& mapped : functions) names.push_back(mapped.name);
    Probe scalar(programs, "basics.cl", 1, names), wide(programs, "basics.cl", width, names);
    for (const Mapped& mapped : functions)
        tally.expect_none(first_bit_difference(wide.run(mapped.name, mapped.in, mapped.words),
                                               scalar.run(mapped.name, mapped.in, mapped.words)),
                          fmt::format("{} at width {}", mapped.name, width));
    tally.expect_none(first_bsdf_difference(programs, width, COUNT),
                      fmt::format("BSDFs at width {}", width));
}

} // namespace

Finding check_lanes(const CheckContext& context) {
    Tally tally;
    for (const uint32_t width : {1u, 8u, 16u}) {
        if (width > 1 && !context.facts().keeps_vectors()) break; // they are taken apart there
        check_masks(tally, context.programs, width);
        if (width > 1) check_functions(tally, context.programs, width);
    }
    return tally.finding("masks and functions differ");
}

} // namespace onde::doctor
