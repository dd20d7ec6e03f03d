// The environment: where its pixels lie in the sky, and samples against their density.
#include "doctor/sky_rig.h"
#include "kernels/scene_probe.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;
using namespace onde::doctor::sky;

TEST_CASE("the middle of every map pixel shows that pixel in the direction of the conventions") {
    for (float rotation : {0.0f, 0.5f, -2.0f, 7.0f}) {
        INFO("rotation " << rotation);
        const Scene scene = make_sky(rotation);
        SceneProbe probe(scene, {"environment"});
        std::vector<glm::vec3> directions;
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++)
                directions.emplace_back(
                    direction_of((x + 0.5) / WIDTH, (y + 0.5) / HEIGHT, rotation));
        const Columns out = look(probe, directions);
        for (uint32_t k = 0; k < 3; k++) {
            const auto wanted = [&](size_t i) {
                return double(scene.environment.radiance[k]) *
                       double(scene.environment.map->pixels[3 * i + k]);
            };
            // A rounding of the place moves a little of the bright neighbour in.
            CHECK(worst_difference(out[5 + k], wanted, 0.02) == "");
        }
    }
}

TEST_CASE("places of axes on the map are those of the conventions") {
    SceneProbe probe(make_sky(), {"environment"});
    const Columns out = look(probe, {{0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}});
    CHECK(out[1][0] == 0.0f);
    CHECK(out[1][1] == 1.0f);
    CHECK(out[0][2] == 0.5f);
    CHECK(out[1][2] == 0.5f);
    CHECK(out[0][3] == 0.75f);
    CHECK(out[0][4] == 0.25f);
}

TEST_CASE("a direction comes back from its place on the map") {
    Generator generator(62);
    const std::vector<glm::vec3> directions = unit_vectors(generator, 1 << 14);
    for (float rotation : {0.0f, 1.0f}) {
        SceneProbe probe(make_sky(rotation), {"environment"});
        const Columns out = look(probe, directions);
        const auto error = [&](size_t i) {
            return glm::length(vector_at(out, 2, i) - glm::dvec3(directions[i]));
        };
        CHECK(worst_item(directions.size(), 1e-5, error, [&](size_t i) {
                  return fmt::format("({}, {}, {})", directions[i].x, directions[i].y,
                                     directions[i].z);
              }) == "");
    }
}

TEST_CASE("the environment's pdf integrates to one, by both tables") {
    for (float sun : {1000.0f, 1.0f}) {
        INFO("sun " << sun);
        SceneProbe probe(make_sky(0.3f, sun), {"environment"});
        for (uint32_t which : {MAP_WHOLE, MAP_COMPENSATED})
            CHECK(integral_of_pdf(probe, 0.3f, which) == Approx(1).epsilon(1e-4));
    }
}

TEST_CASE("environment samples are distributed as their pdf, around a very bright pixel too") {
    for (float rotation : {0.0f, 2.0f})
        for (float sun : {1000.0f, 1.0f})
            for (uint32_t which : {MAP_WHOLE, MAP_COMPENSATED}) {
                INFO("rotation " << rotation << ", sun " << sun << ", tables " << which);
                SceneProbe probe(make_sky(rotation, sun), {"environment"});
                CHECK(distribution_failure(probe, double(rotation), 1 << 18, 1e-4 / 8, which) ==
                      "");
            }
}

TEST_CASE("compensated samples leave out what is darker than half of the mean") {
    Scene scene = make_sky(0, 1);
    Image& map = *scene.environment.map;
    for (uint32_t x = 0; x < WIDTH; x++) std::ranges::fill(map.pixel(x, 2), 0.02f * float(x));
    SceneProbe probe(scene, {"environment"});
    std::vector<glm::vec3> middles;
    std::vector<double> brightness;
    double sum = 0, weights = 0;
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const auto p = map.pixel(x, y);
            middles.emplace_back(direction_of((x + 0.5) / WIDTH, (y + 0.5) / HEIGHT, 0));
            brightness.push_back(double(p[0]) + double(p[1]) + double(p[2]));
            const double sine = std::sin(M_PI * (y + 0.5) / HEIGHT);
            sum += brightness.back() * sine;
            weights += sine;
        }
    const Column whole = look(probe, middles, {}, {}, MAP_WHOLE)[8];
    const Column above = look(probe, middles, {}, {}, MAP_COMPENSATED)[8];
    const double half = MIS_COMPENSATION * sum / weights;
    const auto brightest = size_t(std::ranges::max_element(brightness) - brightness.begin());
    const double scale = double(above[brightest]) / double(whole[brightest]) *
                         brightness[brightest] / (brightness[brightest] - half);
    CHECK(std::ranges::count_if(brightness, [&](double b) { return b < half; }) > 5);
    for (size_t i = 0; i < middles.size(); i++) {
        INFO("pixel " << i << " of brightness " << brightness[i] << ", half of the mean " << half);
        const double expected = std::max(1 - half / brightness[i], 0.0) * scale * double(whole[i]);
        CHECK(double(above[i]) == Approx(expected).margin(2e-3));
    }
}

TEST_CASE("a constant environment is sampled over the sphere and shines alike everywhere") {
    Scene scene = scene_with_a_speck();
    scene.environment.radiance = glm::vec3(0.25f, 0.5f, 1);
    SceneProbe probe(scene, {"environment"});
    Generator generator(64);
    const Columns out = look(probe, unit_vectors(generator, 256), uniform_column(generator, 256),
                             uniform_column(generator, 256));
    for (size_t i = 0; i < 256; i++) {
        REQUIRE(vector_at(out, 5, i) == glm::dvec3(0.25, 0.5, 1));
        REQUIRE(double(out[8][i]) == Approx(0.25 / M_PI));
        REQUIRE(glm::length(vector_at(out, 9, i)) == Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("the environment has the same bits at every width") {
    Generator generator(65);
    const std::vector<glm::vec3> directions = unit_vectors(generator, 4096);
    const Column x = uniform_column(generator, 4096), y = uniform_column(generator, 4096);
    const Scene scene = make_sky(1.5f);
    SceneProbe scalar(scene, {"environment"});
    const Columns one = look(scalar, directions, x, y);
    for (uint32_t width : {8u, 16u}) {
        INFO("width " << width);
        SceneProbe wide(scene, {"environment"}, width);
        CHECK(first_bit_difference(look(wide, directions, x, y), one) == "");
    }
}
