// The environment: where its pixels lie in the sky, and samples against their density.
#include "kernels/scene_probe.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

namespace {

constexpr uint32_t WIDTH = 8, HEIGHT = 4;

/// A dim, uneven sky with one very bright pixel at (6, 1).
Scene sky(float rotation = 0) {
    Generator generator(61);
    Scene scene = scene_with_a_speck();
    Image map(WIDTH, HEIGHT, 3);
    for (float& a : map.pixels) a = 0.1f + 0.4f * unit(generator);
    map.pixel(6, 1)[0] = 1000;
    scene.environment = {glm::vec3(2, 1, 0.5f), std::move(map), rotation};
    return scene;
}

/// The direction of a place on the map: row 0 is up, the centre column is -Z, +X is to the right
/// of it, and rotation turns all that counter-clockwise about +Y seen from above.
glm::dvec3 direction_of(double u, double v, double rotation) {
    const double around = (u - 0.5) * 2 * M_PI, down = v * M_PI;
    const glm::dvec3 d(std::sin(around) * std::sin(down), std::cos(down),
                       -std::cos(around) * std::sin(down));
    const double c = std::cos(rotation), s = std::sin(rotation); // +Z goes to +X
    return {c * d.x + s * d.z, d.y, -s * d.x + c * d.z};
}

Columns look(SceneProbe& probe, const std::vector<glm::vec3>& directions, Column x = {},
             Column y = {}) {
    Columns in;
    add_vectors(in, directions);
    in.push_back(x.empty() ? constant_column(directions.size(), 0.5f) : std::move(x));
    in.push_back(y.empty() ? constant_column(directions.size(), 0.5f) : std::move(y));
    return probe.run("environment", in, 12);
}

} // namespace

TEST_CASE("the middle of every map pixel shows that pixel in the direction of the conventions") {
    for (float rotation : {0.0f, 0.5f, -2.0f, 7.0f}) {
        INFO("rotation " << rotation);
        const Scene scene = sky(rotation);
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
    SceneProbe probe(sky(), {"environment"});
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
        SceneProbe probe(sky(rotation), {"environment"});
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

TEST_CASE("the environment's pdf integrates to one") {
    SceneProbe probe(sky(0.3f), {"environment"});
    // Midpoints of a grid that is finer than the map, so that the steps of the pdf lie between.
    constexpr uint32_t FINE = 32;
    std::vector<glm::vec3> directions;
    Column weights;
    for (uint32_t y = 0; y < HEIGHT * FINE; y++)
        for (uint32_t x = 0; x < WIDTH * FINE; x++) {
            const double v = (y + 0.5) / (HEIGHT * FINE);
            directions.emplace_back(direction_of((x + 0.5) / (WIDTH * FINE), v, 0.3f));
            weights.push_back(
                float(2 * M_PI * M_PI * std::sin(M_PI * v) / (WIDTH * HEIGHT * FINE * FINE)));
        }
    const Column pdf = look(probe, directions)[8];
    double sum = 0;
    for (size_t i = 0; i < pdf.size(); i++) sum += double(pdf[i]) * double(weights[i]);
    CHECK(sum == Approx(1).epsilon(1e-4));
}

TEST_CASE("environment samples are distributed as their pdf, around a very bright pixel too") {
    constexpr size_t COUNT = 1 << 18, FINE = 4; // bins of a pixel along each side
    constexpr size_t COLUMNS = WIDTH * FINE, ROWS = HEIGHT * FINE;
    for (float rotation : {0.0f, 2.0f}) {
        INFO("rotation " << rotation);
        SceneProbe probe(sky(rotation), {"environment"});
        Generator generator(63);
        const Column x = uniform_column(generator, COUNT), y = uniform_column(generator, COUNT);
        const Columns out = look(probe, std::vector<glm::vec3>(COUNT, {0, 1, 0}), x, y);
        std::vector<double> observed(COLUMNS * ROWS), expected;
        for (size_t i = 0; i < COUNT; i++) {
            const glm::dvec3 d = vector_at(out, 9, i);
            double u = std::atan2(d.x, -d.z) / (2 * M_PI) + 0.5 + double(rotation) / (2 * M_PI);
            u -= std::floor(u);
            const double v = std::acos(std::clamp(d.y, -1.0, 1.0)) / M_PI;
            const size_t row = std::min(size_t(v * ROWS), ROWS - 1);
            observed[row * COLUMNS + std::min(size_t(u * COLUMNS), COLUMNS - 1)]++;
        }
        // The device's pdf in the middle of each bin, times the sine, is that of the whole bin.
        std::vector<glm::vec3> middles;
        for (size_t i = 0; i < COLUMNS * ROWS; i++)
            middles.emplace_back(direction_of((double(i % COLUMNS) + 0.5) / COLUMNS,
                                              (double(i / COLUMNS) + 0.5) / ROWS, rotation));
        const Column pdf = look(probe, middles)[8];
        for (size_t i = 0; i < pdf.size(); i++) {
            const double sine = std::sqrt(1 - std::pow(double(middles[i].y), 2));
            expected.push_back(COUNT * double(pdf[i]) * sine * 2 * M_PI * M_PI / (COLUMNS * ROWS));
        }
        CHECK(chi_square_failure(observed, expected, 1e-4 / 2) == "");
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
    const Scene scene = sky(1.5f);
    SceneProbe scalar(scene, {"environment"});
    const Columns one = look(scalar, directions, x, y);
    for (uint32_t width : {8u, 16u}) {
        INFO("width " << width);
        SceneProbe wide(scene, {"environment"}, width);
        CHECK(first_bit_difference(look(wide, directions, x, y), one) == "");
    }
}
