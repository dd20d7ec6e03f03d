// The environment on the device: a small map, and the conventions of where its pixels lie.
#pragma once

#include "doctor/scene_probe.h"
#include "doctor/statistics.h"

#include <bit>

namespace onde::doctor::sky {

inline constexpr uint32_t WIDTH = 8, HEIGHT = 4;

/// A dim, uneven sky with one pixel at (6, 1) that is as red as that.
inline Scene make_sky(float rotation = 0, float sun = 1000) {
    Generator generator(61);
    Scene scene = scene_with_a_speck();
    Image map(WIDTH, HEIGHT, 3);
    for (float& a : map.pixels) a = 0.1f + 0.4f * unit(generator);
    map.pixel(6, 1)[0] = sun;
    scene.environment = {glm::vec3(2, 1, 0.5f), std::move(map), rotation};
    return scene;
}

/// The direction of a place on the map: row 0 is up, the centre column is -Z, +X is to the right
/// of it, and rotation turns all that counter-clockwise about +Y seen from above.
inline glm::dvec3 direction_of(double u, double v, double rotation) {
    const double around = (u - 0.5) * 2 * M_PI, down = v * M_PI;
    const glm::dvec3 d(std::sin(around) * std::sin(down), std::cos(down),
                       -std::cos(around) * std::sin(down));
    const double c = std::cos(rotation), s = std::sin(rotation); // +Z goes to +X
    return {c * d.x + s * d.z, d.y, -s * d.x + c * d.z};
}

/// What rays in these directions find, and directions sampled by x and y from the tables `which`.
inline Columns look(SceneProbe& probe, const std::vector<glm::vec3>& directions, Column x = {},
                    Column y = {}, uint32_t which = MAP_WHOLE) {
    Columns in;
    add_vectors(in, directions);
    in.push_back(x.empty() ? constant_column(directions.size(), 0.5f) : std::move(x));
    in.push_back(y.empty() ? constant_column(directions.size(), 0.5f) : std::move(y));
    in.push_back(constant_column(directions.size(), std::bit_cast<float>(which)));
    return probe.run("environment", in, 12);
}

/// The density over the whole sphere, by the midpoints of a grid that is finer than the map, so
/// that the steps of the density lie between.
inline double integral_of_pdf(SceneProbe& probe, double rotation, uint32_t which = MAP_WHOLE) {
    constexpr uint32_t FINE = 32;
    std::vector<glm::vec3> directions;
    std::vector<double> weights;
    for (uint32_t y = 0; y < HEIGHT * FINE; y++)
        for (uint32_t x = 0; x < WIDTH * FINE; x++) {
            const double v = (y + 0.5) / (HEIGHT * FINE);
            directions.emplace_back(direction_of((x + 0.5) / (WIDTH * FINE), v, rotation));
            weights.push_back(2 * M_PI * M_PI * std::sin(M_PI * v) /
                              (WIDTH * HEIGHT * FINE * FINE));
        }
    const Column pdf = look(probe, directions, {}, {}, which)[8];
    double sum = 0;
    for (size_t i = 0; i < pdf.size(); i++) sum += double(pdf[i]) * weights[i];
    return sum;
}

/// A chi-square test of `count` samples against the density; empty when they agree.
inline std::string distribution_failure(SceneProbe& probe, double rotation, size_t count,
                                        double significance, uint32_t which = MAP_WHOLE) {
    constexpr size_t FINE = 4; // bins of a pixel along each side
    constexpr size_t COLUMNS = WIDTH * FINE, ROWS = HEIGHT * FINE;
    Generator generator(63);
    const Column x = uniform_column(generator, count), y = uniform_column(generator, count);
    const Columns out = look(probe, std::vector<glm::vec3>(count, {0, 1, 0}), x, y, which);
    std::vector<double> observed(COLUMNS * ROWS), expected;
    for (size_t i = 0; i < count; i++) {
        const glm::dvec3 d = vector_at(out, 9, i);
        double u = std::atan2(d.x, -d.z) / (2 * M_PI) + 0.5 + rotation / (2 * M_PI);
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
    const Column pdf = look(probe, middles, {}, {}, which)[8];
    for (size_t i = 0; i < pdf.size(); i++) {
        const double sine = std::sqrt(1 - std::pow(double(middles[i].y), 2));
        expected.push_back(double(count) * double(pdf[i]) * sine * 2 * M_PI * M_PI /
                           (COLUMNS * ROWS));
    }
    return chi_square_failure(observed, expected, significance);
}

} // namespace onde::doctor::sky
