// Lights of every type: how often each is chosen, where it is sampled, and the density with which
// a ray finds it.
#include "doctor/checks.h"
#include "doctor/far_rig.h"
#include "doctor/light_rig.h"
#include "doctor/sky_rig.h"
#include "doctor/tally.h"
#include "gpu/settings.h"
#include "upload/layout_choice.h"

#include <numeric>

namespace onde::doctor {

namespace {

using namespace lights;

/// How the scenes of this check are probed.
struct Probes {
    const CheckContext& context;
    size_t count; ///< of samples

    SceneProbe of(const Scene& scene, const std::vector<std::string>& names) const {
        return SceneProbe(context.programs, scene, names,
                          gpu::default_settings(context.facts()).width, {},
                          {.layout = known_layout(context.facts())});
    }
};

void expect_found(Tally& tally, SceneProbe& probe, const LightSamples& samples, glm::vec3 from,
                  const char* of) {
    size_t found = 0;
    tally.expect_none(found_pdf_failure(probe, samples, from, 1e-4, found), of);
    tally.expect(found + samples.pdf.size() / 1000 + 1 >= samples.pdf.size(), [&] {
        return fmt::format("{}: {} of {} rays to samples find it", of, found, samples.pdf.size());
    });
}

void check_triangle(Tally& tally, const Probes& probes) {
    SceneProbe probe = probes.of(triangle_scene(), {"light_sample", "surface"});
    for (const glm::vec3 from : {glm::vec3(0), glm::vec3(0.2f, 1.5f, 0.3f)}) {
        const LightSamples samples = sample(probe, from, probes.count);
        const auto [angle, deviation] = integrate(samples, [](glm::vec3) { return 1.0; });
        tally.expect_near(angle, solid_angle(TRIANGLE, from), 5 * deviation + 1e-4,
                          "the solid angle of a triangle light");
        const auto [cosine, spread] = integrate(samples, [](glm::vec3 d) { return double(d.y); });
        tally.expect_near(cosine, projected_solid_angle(TRIANGLE, from), 5 * spread + 1e-4,
                          "the cosine over a triangle light");
        expect_found(tally, probe, samples, from, "a triangle light");
    }
}

void check_sphere(Tally& tally, const Probes& probes) {
    SceneProbe probe = probes.of(sphere_scene(true), {"light_sample", "surface"});
    for (const glm::vec3 from : {glm::vec3(0), glm::vec3(1, 2, 3.8f)}) {
        const LightSamples samples = sample(probe, from, probes.count);
        const glm::dvec3 to = glm::dvec3(1, 2, 3) - glm::dvec3(from);
        const double sine2 = 0.75 * 0.75 / glm::dot(to, to);
        const double opening = sine2 / (1 + std::sqrt(1 - sine2));
        const auto [angle, deviation] = integrate(samples, [](glm::vec3) { return 1.0; });
        tally.expect_near(angle, 2 * M_PI * opening, 1e-4 * angle,
                          "the solid angle of a sphere light");
        double sum = 0; // the cosine to the centre is uniform in [1 - opening, 1]
        for (const glm::vec3 d : samples.direction)
            sum += 1 - glm::dot(glm::dvec3(d), glm::normalize(to));
        const double mean = sum / double(probes.count);
        tally.expect_near(mean, opening / 2,
                          opening / 2 * 5 / std::sqrt(3.0 * double(probes.count)) + 2e-7,
                          "the mean angle to a sphere light");
        expect_found(tally, probe, samples, from, "a sphere light");
    }
    const glm::vec3 inside(1.2f, 2.1f, 2.6f);
    const LightSamples samples = sample(probe, inside, probes.count);
    for (size_t i = 0; i < probes.count; i++)
        tally.expect_near(samples.pdf[i], 0.25 / M_PI, 1e-6, "the density inside a sphere light");
    expect_found(tally, probe, samples, inside, "a sphere light seen from inside");
}

/// The choice says which light: what has no geometry is told apart by what it sends.
void check_choice(Tally& tally, const Probes& probes) {
    Scene scene;
    constexpr size_t LIGHTS = 7;
    for (size_t i = 0; i < LIGHTS; i++) { // told apart by their red
        const auto x = float(i);
        add_triangle(scene, {x, 5, 0}, {x + 0.5f, 5, 0}, {x, 5, 0.5f},
                     emitter(i == 3 ? 50.0f : 1 + x));
    }
    SceneProbe probe = probes.of(scene, {"light_sample"});
    const LightSamples samples = sample(probe, {3, 0, 0}, probes.count);
    std::vector<double> observed(LIGHTS), expected;
    for (const glm::vec3 radiance : samples.radiance) {
        const size_t light = radiance.x == 50.0f ? 3 : size_t(radiance.x) - 1;
        if (light < LIGHTS) observed[light]++;
    }
    double total = 0;
    for (const LightRecord& light : probe.packed().lights) {
        expected.push_back(double(probes.count) * double(light.pmf));
        total += double(light.pmf);
    }
    tally.expect_near(total, 1, 1e-6, "the sum of the lights' probabilities");
    tally.expect_none(chi_square_failure(observed, expected, 1e-6), "the choice among lights");
}

/// Among many lights the choice depends on the point, and tells the same probabilities of itself.
void check_tree(Tally& tally, const Probes& probes) {
    SceneProbe probe = probes.of(many_lights(100), {"light_choice"});
    tally.expect(probe.packed().features.light_tree, [] { return "many lights have no tree"; });
    for (const glm::vec3 from : {glm::vec3(5), glm::vec3(-3, 2, 5)})
        for (const glm::vec3 normal : {glm::vec3(0), glm::vec3(0, -1, 0)}) {
            const std::vector<double> all = choice_probabilities(probe, from, normal);
            tally.expect_near(std::accumulate(all.begin(), all.end(), 0.0), 1, 1e-5,
                              "the sum of many lights' probabilities");
            tally.expect_none(choice_failure(probe, from, normal, probes.count, 1e-6),
                              "the choice among many lights");
        }
}

/// All types side by side: each is chosen, and those that rays find are found with the density of
/// the choice and of the sample.
void check_every_type(Tally& tally, const Probes& probes) {
    const Scene scene = every_light();
    SceneProbe probe = probes.of(scene, {"light_sample", "surface"});
    const LightSamples samples = sample(probe, {0, 0, 0}, probes.count);
    const std::vector<LightRecord>& lights = probe.packed().lights;
    double far = 0, near = 0;
    for (size_t i = 0; i < probes.count; i++) {
        tally.expect(samples.pdf[i] > 0,
                     [&] { return fmt::format("sample {} has no density", i); });
        (samples.distance[i] > 1e20f ? far : near) += samples.delta[i];
    }
    const double count = double(probes.count), margin = 5 * 0.5 / std::sqrt(count);
    tally.expect_near(near / count,
                      lights[LIGHT_POINT].pmf + lights[LIGHT_SPOT].pmf +
                          lights[LIGHT_PHOTOMETRIC].pmf,
                      margin, "the share of lights without size");
    tally.expect_near(far / count, lights[LIGHT_DIRECTIONAL].pmf, margin,
                      "the share of directional lights");
    size_t found = 0;
    tally.expect_none(found_pdf_failure(probe, samples, {0, 0, 0}, 1e-4, found),
                      "lights of all types");
}

/// What a light without geometry sends to a point.
void check_delta(Tally& tally, const Probes& probes) {
    Scene scene = scene_with_a_speck();
    scene.point_lights.push_back({{0, 4, 3}, {10, 20, 30}});
    SceneProbe point = probes.of(scene, {"light_sample"});
    const LightSamples near = sample(point, {0, 0, 0}, 16);
    tally.expect_near(near.distance[0], 5, 1e-5, "the distance of a point light");
    tally.expect_near(near.radiance[0].x, 0.4, 1e-6, "what a point light sends");
    tally.expect_near(near.direction[0].y, 0.8, 1e-6, "the way to a point light");

    Scene lamp = scene_with_a_speck();
    SpotLight spot{{0, 0, 0}, {0, 0, -1}, glm::vec3(8)};
    spot.half_angle = 0.6f;
    spot.inner_angle = 0.2f;
    lamp.spot_lights.push_back(spot);
    SceneProbe cone = probes.of(lamp, {"light_sample"});
    const auto at = [&](float angle) {
        return sample(cone, 2.0f * glm::vec3(std::sin(angle), 0, std::cos(angle)), 16);
    };
    tally.expect_near(at(0.1f).radiance[0].x, 2, 2e-4, "what a spot light sends within");
    const double line = (std::cos(0.4) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
    tally.expect_near(at(0.4f).radiance[0].x, 2 * line * line, 2e-3,
                      "what a spot light sends toward its rim");
    tally.expect_near(at(0.62f).valid[0], 0, 0, "whether a spot light shines beside its cone");

    Scene sunny = scene_with_a_speck();
    sunny.directional_lights.push_back({{0, 0.8f, 0.6f}, {1, 2, 3}});
    SceneProbe sun = probes.of(sunny, {"light_sample"});
    const LightSamples far = sample(sun, {100, -5, 2}, 16);
    tally.expect_near(far.direction[0].y, 0.8, 1e-6, "the way to a directional light");
    tally.expect_near(far.radiance[0].z, 3, 0, "what a directional light sends");
}

/// A sun is sampled all over its disk, and found there with the density of that.
void check_sun(Tally& tally, const Probes& probes) {
    const glm::vec3 to_sun(0.6f, 0, -0.8f);
    for (const float angle : {0.01f, 1.0f}) {
        Scene scene = scene_with_a_speck();
        scene.directional_lights.push_back({to_sun, {1, 2, 3}, angle});
        SceneProbe probe = probes.of(scene, {"light_sample", "sun"});
        const LightSamples samples = sample(probe, {0, 0, 0}, probes.count);
        const double opening = 2 * std::pow(std::sin(0.25 * double(angle)), 2);
        tally.expect_none(disk_failure(samples, to_sun, opening, 1e-6), "samples of a sun");
        const Columns found = look_at_sun(probe, samples.direction);
        for (size_t i = 0; i < samples.pdf.size(); i++) {
            if (found[3][i] == 0) continue; // beside the rim by rounding
            tally.expect_near(found[3][i], samples.pdf[i], 1e-5 * double(samples.pdf[i]),
                              "the density of a ray that finds a sun");
            tally.expect_near(found[2][i], samples.radiance[i].z, 0, "what is seen of a sun");
        }
        const auto missed = size_t(std::ranges::count(found[3], 0.0f));
        tally.expect(missed < samples.pdf.size() / 500 + 2,
                     [&] { return fmt::format("{} samples of a sun do not find it", missed); });
    }
}

/// A photometric light sends what its profile says, and emits into each direction as likely as it
/// says.
void check_profile(Tally& tally, const Probes& probes) {
    Scene scene = scene_with_a_speck();
    scene.photometric_lights.push_back(lopsided_lamp({0, 0, 0}, 683));
    SceneProbe probe = probes.of(scene, {"light_sample", "profile"});
    const auto below = [&](float angle) { // toward -Z: 90 degrees around
        return sample(probe, 2.0f * glm::vec3(0, -std::cos(angle), -std::sin(angle)), 16);
    };
    tally.expect_near(below(0).radiance[0].x, 900.0 / 4, 1e-2, "what a lamp sends along its axis");
    const auto degrees = [](float d) { return d * float(M_PI) / 180; };
    tally.expect_near(below(degrees(15)).radiance[0].x, (900 + 300) / 8.0, 1e-2,
                      "what a lamp sends between measured angles");
    tally.expect_near(below(degrees(100)).valid[0], 0, 0, "whether a lamp shines upward");
    tally.expect_none(
        profile_failure(probe, scene.photometric_lights[0].profile, probes.count, 1e-6),
        "directions into which a lamp emits");
}

void check_sky(Tally& tally, const Probes& probes) {
    for (const float rotation : {0.0f, 2.0f}) {
        SceneProbe probe = probes.of(sky::make_sky(rotation), {"environment"});
        for (const uint32_t which : {MAP_WHOLE, MAP_COMPENSATED}) {
            tally.expect_near(sky::integral_of_pdf(probe, rotation, which), 1, 2e-4,
                              "the integral of the environment's density");
            tally.expect_none(
                sky::distribution_failure(probe, rotation, 4 * probes.count, 1e-6, which),
                fmt::format("an environment turned by {} radians, table {}", rotation, which));
        }
        std::vector<glm::vec3> middles;
        for (uint32_t i = 0; i < sky::WIDTH * sky::HEIGHT; i++)
            middles.emplace_back(sky::direction_of((i % sky::WIDTH + 0.5) / sky::WIDTH,
                                                   (i / sky::WIDTH + 0.5) / sky::HEIGHT, rotation));
        const Column red = sky::look(probe, middles)[5];
        const Image map = *sky::make_sky().environment.map;
        for (size_t i = 0; i < red.size(); i++) // rounding moves a little of a neighbour in
            tally.expect_near(red[i], 2 * double(map.pixels[3 * i]), 0.02, "a pixel of the sky");
    }
}

} // namespace

Finding check_lights(const CheckContext& context) {
    const Probes probes{context, context.quick ? size_t(1) << 12 : size_t(1) << 15};
    Tally tally;
    check_triangle(tally, probes);
    check_sphere(tally, probes);
    check_choice(tally, probes);
    check_tree(tally, probes);
    check_every_type(tally, probes);
    check_delta(tally, probes);
    check_sun(tally, probes);
    check_profile(tally, probes);
    check_sky(tally, probes);
    return tally.finding("tests fail");
}

} // namespace onde::doctor
