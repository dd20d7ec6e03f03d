// Renders that their noise ends: what is said of it holds, and the picture is a function of scene,
// options and seed.
#include "render/noise.h"
#include "support/folders.h"

#include "render/picture.h"
#include "render/variants.h"

#include <cmath>
#include <random>

namespace onde::test {
namespace {

Scene scene_of(const char* name) {
    return load_scene(std::filesystem::path(in_project("scenes")) / name);
}

RenderOptions noisy_options(uint32_t width, uint32_t height, float noise) {
    RenderOptions options = small_options(width, height, 4096);
    options.noise = noise;
    options.aovs = 1u << AOV_HALVES;
    return options;
}

Session session_of(const Scene& scene, const RenderOptions& options) {
    return Session(programs(), scene, {.render = options, .choose_layout = false});
}

/// Of the shown values of two pictures, by pixel, root mean square over the colours.
double shown_error(const Image& a, const Image& b, size_t pixel) {
    double sum = 0;
    for (size_t k = 0; k < 3; k++) {
        const double error = shown(a.pixels[3 * pixel + k]) - shown(b.pixels[3 * pixel + k]);
        sum += error * error / 3;
    }
    return std::sqrt(sum);
}

/// The share of the pixels that are off by more than the target.
double share_off(const Image& image, const Image& reference, double target) {
    double off = 0;
    const size_t pixels = image.pixels.size() / 3;
    for (size_t i = 0; i < pixels; i++) off += shown_error(image, reference, i) > target;
    return off / double(pixels);
}

/// Sums of normal errors of `deviation` about `mean`, of as many samples as given.
struct MadeSums {
    static constexpr uint32_t SIDE = 96;
    FilmSums radiance = FilmSums(SIDE * SIDE), halves = radiance;

    MadeSums(float mean, float deviation, float samples) {
        std::mt19937 generator(5);
        std::normal_distribution<float> half(mean, deviation / std::sqrt(0.5f * samples));
        for (size_t i = 0; i < radiance.size(); i++)
            for (size_t k = 0; k < 4; k++) {
                const float first = k < 3 ? half(generator) : 1,
                            second = k < 3 ? half(generator) : 1;
                halves[i].s[k] = second * 0.5f * samples;
                radiance[i].s[k] = (first + second) * 0.5f * samples;
            }
    }
    NoiseSums sums() const { return {SIDE, SIDE, radiance, halves}; }
};

} // namespace

TEST_CASE("what is shown is the square root, and beyond white half the relative error") {
    CHECK(shown(0) == 0);
    CHECK(shown(-1) == 0);
    CHECK(shown(0.25) == 0.5);
    CHECK(shown(1) == 1);
    CHECK(shown(101) - shown(100) == Approx(0.5 * std::log(1.01)));
    CHECK((shown(1.0001) - shown(0.9999)) / 0.0002 == Approx(0.5).epsilon(1e-3)); // no edge
}

TEST_CASE("the noise of normal errors is what it was made of") {
    const float mean = 0.25f, deviation = 0.5f, samples = 256;
    const MadeSums made(mean, deviation, samples);
    const Image error = standard_error(made.sums());
    double sum = 0;
    for (const float number : error.pixels) sum += double(number) * number;
    CHECK(std::sqrt(sum / double(error.pixels.size())) ==
          Approx(deviation / std::sqrt(samples)).epsilon(0.02));

    // The shown value is its square root, whose error is as large where it is 0.5. The three
    // colours are independent here, which is not assumed: pixels are off less often than is said.
    const float target = deviation / std::sqrt(samples);
    const NoiseEstimate estimate(made.sums(), {target, 0});
    CHECK(estimate.share() == Approx(std::erfc(std::sqrt(0.5))).epsilon(0.03));
    double need = 0;
    for (size_t i = 0; i < made.radiance.size(); i++) need += estimate.need(i);
    CHECK(need / double(made.radiance.size()) == Approx(1.96 * 1.96).epsilon(0.06));

    // Twice as bright by one stop, which is the square root of 2 in what is shown.
    const NoiseEstimate brighter(made.sums(), {target * std::sqrt(2.0f), 1});
    CHECK(brighter.share() == Approx(estimate.share()).epsilon(1e-3));
    CHECK_FALSE(estimate.is_sure(0));
    CHECK(NoiseEstimate(made.sums(), {4 * target, 0}).is_sure(0));
}

TEST_CASE("a pixel whose halves differ is not sure, however quiet the pixels around are") {
    MadeSums made(0.25f, 0.001f, 64);
    made.radiance[1000].s[1] += 64 * 0.2f;
    made.halves[1000].s[1] += 64 * 0.2f; // in one of them alone
    const NoiseEstimate estimate(made.sums(), {0.08f, 0});
    CHECK_FALSE(estimate.is_sure(1000));
    CHECK(estimate.is_sure(1001));
}

TEST_CASE("a large error leaves nothing behind in what is averaged") {
    MadeSums made(0.25f, 0, 64);
    made.radiance[1000].s[0] = 1e20f;
    const Image error = standard_error(made.sums());
    CHECK(error.pixels[3 * 1000] > 1e15f);
    CHECK(error.pixels[3 * 1003] == 0);
}

TEST_CASE(
    "no more than 5 % of the pixels are off by more than was asked for, and samples are saved") {
    for (const char* name : {"cornell.toml", "spheres.toml"}) {
        const Scene scene = scene_of(name);
        RenderOptions reference = small_options(40, 30, 1u << 15);
        reference.seed = 77;
        const Image truth = render_scene(scene, reference).image;
        double samples = 0, most_off = 0;
        constexpr int SEEDS = 6;
        RenderOptions options = noisy_options(40, 30, 0.03f);
        Session session = session_of(scene, options);
        for (options.seed = 1; options.seed <= SEEDS; options.seed++) {
            session.set_options(options);
            const RenderOutcome outcome = session.render();
            INFO(name << ", seed " << options.seed);
            const double off = share_off(session.picture(), truth, 0.03);
            CHECK(off < NOISY_SHARE);
            CHECK(session.noise()->share < NOISY_SHARE);
            CHECK(session.noise()->fewest == 64);
            CHECK(session.noise()->most > 64);
            const Image counts = session.film().develop(SAMPLE_COUNT);
            double all = 0;
            for (const float count : counts.pixels) all += count;
            CHECK(outcome.samples == Approx(all / double(counts.pixels.size())));
            samples += outcome.samples / SEEDS;
            most_off = std::max(most_off, off);
        }
        // As many samples everywhere leave more pixels off.
        RenderOptions uniform = small_options(40, 30, uint32_t(samples));
        uniform.seed = 1;
        CHECK(share_off(render_scene(scene, uniform).image, truth, 0.03) > most_off);
    }
}

TEST_CASE(
    "a picture that its noise ends has the same bits in every engine and however interrupted") {
    const Scene scene = scene_of("spheres.toml");
    RenderOptions options = noisy_options(24, 16, 0.04f);
    options.aovs |= 1u << AOV_ALBEDO;
    Session whole = session_of(scene, options);
    whole.render();
    const FilmContents expected = whole.film().contents();
    const Image picture = whole.picture();
    CHECK(expected.extent.end > 128);
    for (const Variant& variant : VARIANTS) {
        Session session = session_of(scene, apply(options, variant));
        session.render();
        INFO(variant.name);
        CHECK(first_difference(session.picture(), picture) == "");
    }
    for (const double stop : {30.0, 64.0, 100.0, 200.0}) {
        RenderOptions small = options;
        small.settings.wave_size = 16 * small.settings.chunk; // several waves a pass
        Session first = session_of(scene, small), second = session_of(scene, options);
        first.render([&](const Progress& progress) { return progress.samples < stop; });
        second.restore_film(first.keep_film());
        second.render();
        INFO("interrupted after " << first.film().samples());
        CHECK(second.film().contents().extent == expected.extent);
        CHECK(first_difference(second.picture(), picture) == "");
    }
}

TEST_CASE("of the samples that are allowed at most, no pixel gets more, and it is said") {
    RenderOptions options = noisy_options(24, 16, 0.002f);
    options.samples = 100;
    Session session = session_of(scene_of("cornell.toml"), options);
    CHECK(session.render().samples <= 100);
    CHECK(session.film().extent().end == 100);
    CHECK_FALSE(session.noise()->is_met);
    CHECK(session.findings().back().find("some pixels need more") != std::string::npos);
}

TEST_CASE("noise can't be had of other integrators or later samples") {
    RenderOptions options = noisy_options(8, 8, 0.02f);
    check_options(options);
    options.first_sample = 64;
    CHECK_THROWS_AS(check_options(options), InputError);
    options = noisy_options(8, 8, 0.02f);
    options.aovs = 0;
    CHECK_THROWS_AS(check_options(options), InputError);
    options = noisy_options(8, 8, 0.02f);
    options.integrator = IntegratorKind::light;
    CHECK_THROWS_AS(check_options(options), InputError);
}

} // namespace onde::test
