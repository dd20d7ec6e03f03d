// The random numbers, which are a pure function of pixel, sample, dimension and seed: their exact
// values, as this version has them on every device, and that they are stratified.
#include "doctor/checks.h"
#include "doctor/columns.h"
#include "doctor/exact_random.h"
#include "doctor/statistics.h"
#include "doctor/tally.h"
#include "gpu/settings.h"

namespace onde::doctor {

namespace {

/// `count` samples from `first` on.
Points draw(Probe& probe, uint32_t pixel, uint32_t first, uint32_t count, uint32_t dimension,
            uint32_t seed) {
    Columns in{
        word_column(count, pixel), {}, word_column(count, dimension), word_column(count, seed)};
    for (uint32_t i = 0; i < count; i++) in[1].push_back(word(first + i));
    Columns out = probe.run("random", in, 2);
    return {std::move(out[0]), std::move(out[1])};
}

/// As the 24 bits that the numbers have.
uint32_t bits_of(float number) {
    return uint32_t(number * 0x1p24f);
}

} // namespace

Finding check_random(const CheckContext& context) {
    Probe probe(context.programs, "basics.cl", gpu::default_settings(context.facts()).width,
                {"random"});
    Tally tally;
    for (const ExactPair& exact : EXACT_PAIRS) {
        const Points got = draw(probe, exact.pixel, exact.sample, 1, exact.dimension, exact.seed);
        const auto expect = [&](float number, uint32_t wanted) {
            tally.expect(bits_of(number) == wanted, [&] {
                return fmt::format("pixel {:#x}, sample {}, dimension {}, seed {}: {} instead of "
                                   "{}",
                                   exact.pixel, exact.sample, exact.dimension, exact.seed, number,
                                   float(wanted) * 0x1p-24f);
            });
        };
        expect(got.x[0], exact.x);
        expect(got.y[0], exact.y);
    }
    for (const uint32_t pixel : {0u, 5u | 7u << 16, 1919u | 1079u << 16})
        for (const uint32_t dimension : {0u, 1u, 5u, 30u}) {
            constexpr uint32_t LOG2_COUNT = 6;
            const Points points = draw(probe, pixel, 0, 1u << LOG2_COUNT, dimension, 1);
            tally.expect_none(find_uneven_interval(points, LOG2_COUNT),
                              fmt::format("64 samples of dimension {}", dimension));
        }
    return tally.finding("numbers and sequences differ");
}

} // namespace onde::doctor
