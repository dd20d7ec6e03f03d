// Lights: which one is chosen, where it is sampled, and the density of a ray that finds it.
#include "doctor/far_rig.h"
#include "doctor/light_rig.h"
#include "kernels/scene_probe.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;
using namespace onde::doctor::lights;

namespace {

constexpr size_t COUNT = 1 << 15;

LightSamples sample(SceneProbe& probe, glm::vec3 from, size_t count = COUNT) {
    return doctor::lights::sample(probe, from, count);
}

/// Rays along the samples find the light at the same distance with the same density. Rays along
/// the light's border may miss it.
void check_found_pdf(SceneProbe& probe, glm::vec3 from, double bound) {
    size_t found = 0;
    CHECK(found_pdf_failure(probe, sample(probe, from), from, bound, found) == "");
    CHECK(found > COUNT - COUNT / 1000);
}

} // namespace

TEST_CASE("lights are chosen by their probabilities") {
    Scene scene;
    for (int i = 0; i < 7; i++) { // told apart by their red
        const auto x = float(i);
        const float power = i == 3 ? 50.0f : 1 + x;
        add_triangle(scene, {x, 5, 0}, {x + 0.5f, 5, 0}, {x, 5, 0.5f}, emitter(power));
    }
    SceneProbe probe(scene, {"light_sample"});
    const LightSamples samples = sample(probe, {3, 0, 0});
    std::vector<double> observed(7), expected;
    for (glm::vec3 radiance : samples.radiance)
        observed[radiance.x == 50.0f ? 3 : size_t(radiance.x) - 1]++;
    double total = 0;
    for (const LightRecord& light : probe.packed().lights) {
        expected.push_back(COUNT * double(light.pmf));
        total += double(light.pmf);
    }
    CHECK(total == Approx(1).epsilon(1e-6));
    CHECK(chi_square_failure(observed, expected, 1e-4) == "");
}

TEST_CASE("the solid angle of a triangle light is the mean of one over its density") {
    SceneProbe probe(triangle_scene(), {"light_sample", "surface"});
    for (glm::vec3 from : {glm::vec3(0), glm::vec3(0.2f, 1.5f, 0.3f), glm::vec3(-8, -3, 5)}) {
        INFO("from " << from.x << " " << from.y << " " << from.z);
        const LightSamples samples = sample(probe, from);
        const auto [angle, deviation] = integrate(samples, [](glm::vec3) { return 1.0; });
        CHECK(angle == Approx(solid_angle(TRIANGLE, from)).epsilon(1e-4).margin(5 * deviation));
        const auto [cosine, spread] = integrate(samples, [](glm::vec3 d) { return double(d.y); });
        CHECK(cosine ==
              Approx(projected_solid_angle(TRIANGLE, from)).epsilon(1e-4).margin(5 * spread));
        check_found_pdf(probe, from, 1e-4);
    }
}

TEST_CASE("a triangle light shines from its front only, unless it is two-sided") {
    const glm::vec3 behind(0.2f, 9, 0.3f);
    SceneProbe one_sided(triangle_scene(false), {"light_sample", "surface"});
    for (float valid : sample(one_sided, behind).valid) REQUIRE(valid == 0.0f);
    for (float valid : sample(one_sided, {0, 0, 0}).valid) REQUIRE(valid == 1.0f);
    SceneProbe two_sided(triangle_scene(true), {"light_sample", "surface"});
    for (float valid : sample(two_sided, behind).valid) REQUIRE(valid == 1.0f);
    check_found_pdf(two_sided, behind, 1e-4);
}

TEST_CASE("a sphere light is sampled over the angle under which it is seen") {
    for (glm::vec3 from : {glm::vec3(0), glm::vec3(1, 2, 3.8f), glm::vec3(60, -80, 20)}) {
        INFO("from " << from.x << " " << from.y << " " << from.z);
        SceneProbe probe(sphere_scene(false), {"light_sample", "surface"});
        const LightSamples samples = sample(probe, from);
        const glm::dvec3 to = glm::dvec3(1, 2, 3) - glm::dvec3(from);
        const double sine2 = 0.75 * 0.75 / glm::dot(to, to);
        const double opening = sine2 / (1 + std::sqrt(1 - sine2));
        const auto [angle, deviation] = integrate(samples, [](glm::vec3) { return 1.0; });
        CHECK(angle == Approx(2 * M_PI * opening).epsilon(1e-4));
        // The cosine to the centre is uniform in [1 - opening, 1].
        double sum = 0;
        for (glm::vec3 d : samples.direction)
            sum += 1 - glm::dot(glm::dvec3(d), glm::normalize(to));
        CHECK(sum / COUNT == Approx(opening / 2)
                                 .epsilon(5 / std::sqrt(3.0 * COUNT)) //
                                 .margin(2e-7));
        check_found_pdf(probe, from, 1e-4);
        for (float valid : samples.valid) REQUIRE(valid == 1.0f);
    }
}

TEST_CASE("inside, a two-sided sphere light is sampled all around, a one-sided one not at all") {
    const glm::vec3 from(1.2f, 2.1f, 2.6f);
    SceneProbe two_sided(sphere_scene(true), {"light_sample", "surface"});
    const LightSamples samples = sample(two_sided, from);
    for (size_t i = 0; i < COUNT; i++) {
        REQUIRE((samples.valid[i] == 1 && samples.distance[i] > 0));
        REQUIRE(double(samples.pdf[i]) == Approx(0.25 / M_PI));
        const glm::vec3 end = from + samples.distance[i] * samples.direction[i];
        REQUIRE(glm::length(end - glm::vec3(1, 2, 3)) == Approx(0.75).epsilon(1e-5));
    }
    check_found_pdf(two_sided, from, 1e-4);
    SceneProbe one_sided(sphere_scene(false), {"light_sample"});
    for (float valid : sample(one_sided, from).valid) REQUIRE(valid == 0.0f);
}

TEST_CASE("the choice of the light is part of every density") {
    Scene scene = triangle_scene();
    scene.materials.push_back(emitter(5));
    scene.spheres.push_back({{-3, 1, 0}, 0.5f, 1});
    scene.point_lights.push_back({{0, -4, 3}, {10, 20, 30}});
    SceneProbe probe(scene, {"light_sample", "surface"});
    const LightSamples samples = sample(probe, {0, 0, 0});
    LightSamples areas = samples;
    for (size_t i = 0; i < COUNT; i++) {
        if (samples.delta[i] == 0) continue;
        areas.valid[i] = 0;
        REQUIRE(samples.pdf[i] == probe.packed().lights[2].pmf);
    }
    const double sine2 = 0.25 / 10;
    const double sphere = 2 * M_PI * (1 - std::sqrt(1 - sine2));
    const auto [angle, deviation] = integrate(areas, [](glm::vec3) { return 1.0; });
    CHECK(angle == Approx(solid_angle(TRIANGLE, {0, 0, 0}) + sphere).margin(5 * deviation));
    CHECK(deviation < 0.02);
    size_t found = 0;
    CHECK(found_pdf_failure(probe, areas, {0, 0, 0}, 1e-4, found) == "");
}

TEST_CASE("a scene may have every type of light, and each is sampled with its probability") {
    const Scene scene = every_light();
    SceneProbe probe(scene, {"light_sample"});
    REQUIRE(probe.packed().features.lights == ALL_LIGHTS);

    // The choice says which light: its share of [0, 1) is one column of the alias table.
    const std::vector<LightRecord>& lights = probe.packed().lights;
    REQUIRE(lights.size() == LIGHT_TYPE_COUNT);
    const LightSamples samples = sample(probe, {0, 0, 0});
    std::vector<double> deltas(2);
    for (size_t i = 0; i < COUNT; i++) {
        REQUIRE(samples.pdf[i] > 0);
        if (samples.delta[i] != 0)
            deltas[samples.distance[i] > 1e20f]++;
        else
            REQUIRE(samples.valid[i] == 1);
    }
    const double share[] = {lights[LIGHT_POINT].pmf + lights[LIGHT_SPOT].pmf +
                                lights[LIGHT_PHOTOMETRIC].pmf,
                            lights[LIGHT_DIRECTIONAL].pmf};
    for (size_t k = 0; k < 2; k++)
        CHECK(deltas[k] / COUNT == Approx(share[k]).margin(5 * 0.5 / std::sqrt(COUNT)));
}

TEST_CASE("point lights fall off with the square of the distance, directional ones do not") {
    Scene scene = scene_with_a_speck();
    scene.point_lights.push_back({{0, 4, 3}, {10, 20, 30}});
    SceneProbe point(scene, {"light_sample"});
    const LightSamples near = sample(point, {0, 0, 0}, 16);
    CHECK(glm::length(near.direction[0] - glm::vec3(0, 0.8f, 0.6f)) < 1e-6f);
    CHECK(near.distance[0] == Approx(5));
    CHECK(glm::length(near.radiance[0] - glm::vec3(0.4f, 0.8f, 1.2f)) < 1e-6f);
    CHECK((near.pdf[0] == 1 && near.delta[0] == 1 && near.valid[0] == 1));

    Scene sunny = scene_with_a_speck();
    sunny.directional_lights.push_back({{0, 0.8f, 0.6f}, {1, 2, 3}});
    SceneProbe directional(sunny, {"light_sample"});
    const LightSamples far = sample(directional, {100, -5, 2}, 16);
    CHECK(far.direction[0] == glm::vec3(0, 0.8f, 0.6f));
    CHECK(far.distance[0] > 1e20f);
    CHECK(far.radiance[0] == glm::vec3(1, 2, 3));
    CHECK((far.pdf[0] == 1 && far.delta[0] == 1 && far.valid[0] == 1));
}

TEST_CASE("spot lights shine as points inside their inner cone, and fade to their rim") {
    Scene scene = scene_with_a_speck();
    SpotLight spot{{0, 0, 0}, {0, 0, -1}, glm::vec3(8)};
    spot.half_angle = 0.6f;
    spot.inner_angle = 0.2f;
    scene.spot_lights.push_back(spot);
    SceneProbe probe(scene, {"light_sample"});
    const auto at = [&](float angle) {
        return sample(probe, 2.0f * glm::vec3(std::sin(angle), 0, std::cos(angle)), 16);
    };
    CHECK(at(0.1f).radiance[0].x == Approx(2).epsilon(1e-4));
    const double line = (std::cos(0.4) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
    CHECK(at(0.4f).radiance[0].x == Approx(2 * line * line).epsilon(1e-3));
    CHECK(at(0.4f).valid[0] == 1);
    CHECK(at(0.62f).valid[0] == 0);
    CHECK(at(3.0f).valid[0] == 0);
}

TEST_CASE("mixed lights have the same bits at every width, beside dead lanes full of poison") {
    Scene scene = triangle_scene(true);
    scene.materials.push_back(emitter(2, true));
    scene.spheres.push_back({{-2, 1, 0}, 0.5f, 1});
    scene.point_lights.push_back({{0, 4, 3}, {10, 20, 30}});
    scene.photometric_lights.push_back(lopsided_lamp({0, 5, 0}, 20));
    scene.directional_lights.push_back({{0, 0.8f, 0.6f}, {1, 2, 3}});
    scene.directional_lights.push_back({{0, 0.6f, 0.8f}, {3, 2, 1}, 0.1f});
    scene.environment.radiance = glm::vec3(0.5f);
    Generator generator(73);
    constexpr size_t FEW = 4096;
    Columns in(7, Column(FEW));
    for (size_t i = 0; i < FEW; i++) {
        const bool live = i / 16 % 5 && generator() % 3;
        for (size_t k = 0; k < 6; k++)
            in[k][i] = live ? unit(generator) : generator() % 2 ? NAN : -INFINITY;
        in[6][i] = live;
    }
    for (size_t i = 0; i < FEW; i++) // a number must be one to choose a light, even in dead lanes
        if (in[6][i] == 0) in[3][i] = in[4][i] = 0.5f;
    Columns rays(in.begin(), in.end());
    for (size_t i = 0; i < FEW; i++)
        if (in[6][i] != 0) {
            const glm::vec3 d = unit_vector(generator);
            for (uint32_t k = 0; k < 3; k++) rays[3 + k][i] = d[k];
        }
    SceneProbe scalar(scene, {"light_sample", "surface"});
    const Columns samples = scalar.run("light_sample", in, 10);
    const Columns surfaces = scalar.run("surface", rays, 18);
    CHECK(std::ranges::count(surfaces[0], 1.0f) > 100);
    for (uint32_t width : {8u, 16u}) {
        INFO("width " << width);
        SceneProbe wide(scene, {"light_sample", "surface"}, width);
        CHECK(first_bit_difference(wide.run("light_sample", in, 10), samples, in[6]) == "");
        CHECK(first_bit_difference(wide.run("surface", rays, 18), surfaces, surfaces[0]) == "");
    }
}

TEST_CASE("a sun is sampled all over its disk, and found there and nowhere else") {
    const glm::vec3 middle = glm::normalize(glm::vec3(2, 3, -1));
    for (const double degrees : {0.02, 0.53, 30.0, 180.0}) {
        INFO(degrees << " degrees");
        Scene scene = scene_with_a_speck();
        const double angle = degrees * M_PI / 180;
        scene.directional_lights.push_back({middle, {1, 2, 3}, float(angle)});
        SceneProbe probe(scene, {"light_sample", "sun"});
        const double opening = 2 * std::pow(std::sin(angle / 4), 2);
        const LightSamples samples = sample(probe, {5, -3, 2});
        CHECK(disk_failure(samples, middle, opening, 1e-4) == "");
        const auto [solid, deviation] = integrate(samples, [](glm::vec3) { return 1.0; });
        CHECK(solid == Approx(2 * M_PI * opening).epsilon(1e-5));
        const Columns found = look_at_sun(probe, samples.direction);
        size_t beside = 0;
        for (size_t i = 0; i < COUNT; i++) {
            REQUIRE(
                (samples.delta[i] == 0 && samples.valid[i] == 1 && samples.distance[i] > 1e20f));
            beside += found[3][i] == 0;
            if (found[3][i] == 0) continue;
            REQUIRE(double(found[3][i]) == Approx(double(samples.pdf[i])));
            REQUIRE(glm::vec3(vector_at(found, 0, i)) == samples.radiance[i]);
        }
        CHECK(beside < COUNT / 500); // by rounding at the rim
        // The irradiance facing it, from the radiance.
        const double sine = std::sin(angle / 2);
        CHECK(double(samples.radiance[0].z) * M_PI * sine * sine == Approx(3).epsilon(1e-5));
        std::vector<glm::vec3> off;
        const glm::dvec3 across =
            glm::normalize(glm::cross(glm::dvec3(middle), glm::dvec3(0, 1, 0)));
        for (const double share : {1.01, 1.5, 2.0})
            if (degrees < 180)
                off.emplace_back(std::cos(share * angle / 2) * glm::dvec3(middle) +
                                 std::sin(share * angle / 2) * across);
        const Columns beyond = look_at_sun(probe, off);
        for (const float pdf : beyond[3]) CHECK(pdf == 0.0f);
    }
}

TEST_CASE("a directional light of almost no angle is a point at infinity") {
    Scene scene = scene_with_a_speck();
    scene.directional_lights.push_back({{0, 0.8f, 0.6f}, {1, 2, 3}, 1e-5f});
    SceneProbe probe(scene, {"light_sample"});
    CHECK(probe.packed().lights[0].kind == LIGHT_DIRECTIONAL);
    CHECK(sample(probe, {0, 0, 0}, 16).radiance[0] == glm::vec3(1, 2, 3));
}

TEST_CASE("a photometric light sends what its profile states, turned as the lamp is") {
    Scene scene = scene_with_a_speck();
    PhotometricLight lamp = lopsided_lamp({1, 2, 3}, 683);
    lamp.back = {0, 0, -1}; // shines along +Z
    lamp.start = {0, 2, 5};
    scene.photometric_lights.push_back(lamp);
    SceneProbe probe(scene, {"light_sample"});
    const auto toward = [&](glm::vec3 d) {
        return double(sample(probe, glm::vec3(1, 2, 3) + 2.0f * d, 16).radiance[0].x) * 4;
    };
    const auto at = [&](double polar, double around) { // against the clock, from behind the lamp
        const double v = polar * M_PI / 180, h = around * M_PI / 180;
        const glm::dvec3 x(0, 1, 0), y = glm::cross(glm::dvec3(lamp.back), x);
        return toward(glm::vec3(std::sin(v) * (std::cos(h) * x + std::sin(h) * y) -
                                std::cos(v) * glm::dvec3(lamp.back)));
    };
    CHECK(at(0, 0) == Approx(900));
    CHECK(at(30, 0) == Approx(600).epsilon(1e-5));
    CHECK(at(30, 90) == Approx(300).epsilon(1e-5));
    CHECK(at(30, 180) == Approx(150).epsilon(1e-5));
    CHECK(at(30, 270) == Approx(450).epsilon(1e-5));
    CHECK(at(45, 135) == Approx(0.5 * (600 + 200) * 0.375).epsilon(1e-5)); // between four nodes
    CHECK(at(15, 315) == Approx(0.5 * (900 + 600 * 0.875)).epsilon(1e-5));
    CHECK(at(100, 0) == 0);
}

TEST_CASE("photometric lights emit by their profiles") {
    Scene scene = scene_with_a_speck();
    scene.photometric_lights.push_back(lopsided_lamp({0, 0, 0}, 1));
    SceneProbe lamp(scene, {"profile"});
    CHECK(profile_failure(lamp, scene.photometric_lights[0].profile, COUNT, 1e-4) == "");
    Generator generator(77);
    LightProfile& fine = scene.photometric_lights[0].profile;
    fine.rows = 720;
    fine.columns = 24;
    fine.candela.clear();
    for (uint32_t i = 0; i < (fine.rows + 1) * fine.columns; i++)
        fine.candela.push_back(unit(generator));
    SceneProbe any(scene, {"profile"});
    const Columns out =
        ask_profile(any, std::vector(COUNT, glm::vec3(0, 0, 1)), uniform_column(generator, COUNT),
                    uniform_column(generator, COUNT));
    std::vector<glm::vec3> directions;
    for (size_t i = 0; i < COUNT; i++) directions.emplace_back(vector_at(out, 1, i));
    const Columns values =
        ask_profile(any, directions, constant_column(COUNT, 0.5f), constant_column(COUNT, 0.5f));
    double power = 0;
    for (size_t i = 0; i < COUNT; i++)
        power += double(values[0][i]) / double(out[4][i]) / double(COUNT);
    CHECK(power == Approx(emitted_power(fine)).epsilon(0.01));
}
