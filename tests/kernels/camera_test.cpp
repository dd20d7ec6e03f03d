// Camera rays: where pixels lie, how samples spread over the filter, and the thin lens.
#include "kernels/scene_probe.h"
#include "kernels/statistics.h"
#include "render/filter.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace onde;
using namespace onde::test;

namespace {

constexpr uint32_t WIDTH = 255, HEIGHT = 129;
const Filter FILTERS[] = {Filter::box, Filter::tent, Filter::gaussian, Filter::blackman_harris};

struct Rays {
    std::vector<glm::dvec3> origin, direction;
};

/// One sample of every pixel.
Rays picture(const Camera& camera, Filter filter, uint32_t sample = 0) {
    Scene scene = scene_with_a_speck();
    scene.cameras.push_back(camera);
    RenderOptions options;
    options.width = WIDTH;
    options.height = HEIGHT;
    options.filter = filter;
    SceneProbe probe(scene, {"camera"}, 1, options);
    Columns in(2);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            in[0].push_back(word(x | y << 16));
            in[1].push_back(word(sample));
        }
    const Columns out = probe.run("camera", in, 6);
    Rays rays;
    for (size_t i = 0; i < out[0].size(); i++) {
        rays.origin.push_back(vector_at(out, 0, i));
        rays.direction.push_back(vector_at(out, 3, i));
    }
    return rays;
}

/// Where a camera-space direction meets the film, in pixels, y downward.
glm::dvec2 on_film(glm::dvec3 d, double fov) {
    const double scale = HEIGHT / (2 * std::tan(fov / 2));
    return {WIDTH / 2.0 + d.x / -d.z * scale, HEIGHT / 2.0 - d.y / -d.z * scale};
}

glm::dvec2 offset_from_pixel(size_t i, glm::dvec2 at) {
    return at - glm::dvec2(double(i % WIDTH) + 0.5, double(i / WIDTH) + 0.5);
}

Camera wide_camera() {
    Camera camera;
    camera.vertical_fov = 1.2f;
    camera.focus_distance = 3;
    return camera;
}

} // namespace

TEST_CASE("a screen of real size has its pixels where the chapter's formula puts them") {
    // E(i, j) = first pixel + (i a / Nx, j b / Ny), f away, j growing upward; the sample lies
    // within.
    Camera camera;
    camera.screen = ScreenWindow{{2.55f, 1.29f}, 2.0f, glm::vec2(0.3f, -0.2f)};
    const Rays rays = picture(camera, Filter::box);
    for (size_t i = 0; i < rays.direction.size(); i++) {
        const glm::dvec3 d = rays.direction[i];
        const double column = double(i % WIDTH), row = double(HEIGHT - 1 - i / WIDTH);
        INFO("pixel " << column << "," << row);
        REQUIRE(std::abs(2 * d.x / -d.z - (0.3 + 0.01 * column)) < 0.0050001);
        REQUIRE(std::abs(2 * d.y / -d.z - (-0.2 + 0.01 * row)) < 0.0050001);
    }
}

TEST_CASE("a screen without a first pixel is centred like a field of view") {
    Camera by_screen, by_angle;
    by_screen.screen = ScreenWindow{{2.55f, 1.29f}, 2.0f, {}};
    by_angle.vertical_fov = float(2 * std::atan(1.29 / 4));
    const Rays a = picture(by_screen, Filter::box), b = picture(by_angle, Filter::box);
    double worst = 0;
    for (size_t i = 0; i < a.direction.size(); i++)
        worst = std::max(worst, glm::length(a.direction[i] - b.direction[i]));
    CHECK(worst < 1e-6);
}

TEST_CASE("orthographic rays are parallel and start side by side") {
    Camera camera;
    camera.orthographic_height = 1.29f;
    const Rays rays = picture(camera, Filter::box);
    for (size_t i = 0; i < rays.direction.size(); i++) {
        REQUIRE(rays.direction[i] == glm::dvec3(0, 0, -1));
        const double x = 0.01 * (double(i % WIDTH) + 0.5) - 1.275;
        const double y = 0.645 - 0.01 * (double(i / WIDTH) + 0.5);
        REQUIRE(std::abs(rays.origin[i].x - x) < 0.0050001);
        REQUIRE(std::abs(rays.origin[i].y - y) < 0.0050001);
        REQUIRE(rays.origin[i].z == 0.0);
    }
}

TEST_CASE("every ray goes through its pixel within the radius of the filter") {
    const Camera camera = wide_camera();
    for (Filter filter : FILTERS) {
        INFO("filter " << uint32_t(filter));
        const Rays rays = picture(camera, filter);
        const double radius = filter_radius(filter) + 1e-3;
        const auto error = [&](size_t i) {
            const glm::dvec2 offset =
                offset_from_pixel(i, on_film(rays.direction[i], camera.vertical_fov));
            return std::max(std::abs(offset.x), std::abs(offset.y));
        };
        CHECK(worst_item(rays.direction.size(), radius, error, [&](size_t i) {
                  const glm::dvec3 d = rays.direction[i];
                  return fmt::format("({}, {}, {})", d.x, d.y, d.z);
              }) == "");
        for (size_t i = 0; i < rays.direction.size(); i++) {
            REQUIRE(rays.origin[i] == glm::dvec3(0));
            REQUIRE(glm::length(rays.direction[i]) == Approx(1).epsilon(1e-6));
        }
    }
}

TEST_CASE("the centre pixel looks along -Z, the first row up, the first column left") {
    const Rays rays = picture(wide_camera(), Filter::box);
    const glm::dvec3 centre = rays.direction[(HEIGHT / 2) * WIDTH + WIDTH / 2];
    CHECK(glm::length(centre - glm::dvec3(0, 0, -1)) < 0.01);
    CHECK(rays.direction[WIDTH / 2].y > 0.5);
    CHECK(rays.direction[(HEIGHT / 2) * WIDTH].x < -0.5);
}

TEST_CASE("a camera that is placed turns its rays and moves their origins") {
    Camera camera = wide_camera();
    const Rays plain = picture(camera, Filter::tent);
    camera.camera_to_world = glm::rotate(glm::translate(glm::mat4(1), glm::vec3(5, 6, 7)), 0.8f,
                                         glm::normalize(glm::vec3(1, 2, 3)));
    const Rays placed = picture(camera, Filter::tent);
    const glm::dmat3 turn(glm::mat3(camera.camera_to_world));
    const auto error = [&](size_t i) {
        return glm::length(placed.direction[i] - turn * plain.direction[i]);
    };
    CHECK(worst_item(plain.direction.size(), 1e-5, error, [&](size_t i) {
              const glm::dvec3 d = placed.direction[i];
              return fmt::format("({}, {}, {})", d.x, d.y, d.z);
          }) == "");
    CHECK(placed.origin[9] == glm::dvec3(5, 6, 7));
}

TEST_CASE("the knots of filter tables divide the filter into equal shares") {
    for (Filter filter : FILTERS) {
        INFO("filter " << uint32_t(filter));
        const auto table = filter_table(filter);
        const double radius = filter_radius(filter);
        constexpr int STEPS = 1 << 16;
        std::vector<double> below(STEPS + 1);
        for (size_t i = 0; i < STEPS; i++)
            below[i + 1] =
                below[i] + filter_value(filter, radius * (2 * (double(i) + 0.5) / STEPS - 1));
        for (size_t i = 0; i < table.size(); i++) {
            const double place = (double(table[i]) / radius + 1) / 2 * STEPS;
            const auto whole = std::min(size_t(std::max(place, 0.0)), size_t(STEPS - 1));
            const double share =
                std::lerp(below[whole], below[whole + 1], place - double(whole)) / below.back();
            REQUIRE(share == Approx(double(i) / double(table.size() - 1)).margin(1e-4));
        }
    }
}

TEST_CASE("offsets in the pixel are distributed as the filter's table, in x and y") {
    const Camera camera = wide_camera();
    for (Filter filter : FILTERS) {
        INFO("filter " << uint32_t(filter));
        const auto table = filter_table(filter);
        const Rays rays = picture(camera, filter);
        const size_t gaps = table.size() - 1;
        std::vector<double> x(gaps), y(gaps);
        const auto count = [&](std::vector<double>& bins, double offset) {
            const auto above = std::upper_bound(table.begin() + 1, table.end() - 1, offset);
            bins[size_t(above - table.begin() - 1)]++;
        };
        for (size_t i = 0; i < rays.direction.size(); i++) {
            const glm::dvec2 offset =
                offset_from_pixel(i, on_film(rays.direction[i], camera.vertical_fov));
            count(x, offset.x);
            count(y, offset.y);
        }
        const std::vector<double> expected(gaps, double(rays.direction.size()) / double(gaps));
        CHECK(chi_square_failure(x, expected, 1e-4 / 8) == "");
        CHECK(chi_square_failure(y, expected, 1e-4 / 8) == "");
    }
}

TEST_CASE("filter offsets are those of the table at its knots, and monotonic up to its end") {
    RenderOptions options;
    options.filter = Filter::gaussian;
    SceneProbe probe(scene_with_a_speck(), {"filter"}, 1, options);
    const auto table = filter_table(Filter::gaussian);
    Column numbers;
    for (size_t i = 0; i + 1 < table.size(); i++)
        numbers.push_back(std::nextafter(float(i) / float(table.size() - 1), 2.0f));
    numbers.push_back(0x1.fffffep-1f); // the largest there is below one
    const Column out = probe.run("filter", {numbers}, 1)[0];
    CHECK(worst_difference(
              out, [&](size_t i) { return table[i]; }, 1e-4) == "");
    CHECK(std::ranges::is_sorted(out));
}

TEST_CASE("the rays of a thin lens start on its disk and meet their pinhole's rays in focus") {
    Camera camera = wide_camera();
    const Rays pinhole = picture(camera, Filter::box);
    camera.aperture_radius = 0.25f;
    const Rays lens = picture(camera, Filter::box);
    const auto at_depth = [](const Rays& rays, size_t i, double z) {
        const double t = (-z - rays.origin[i].z) / rays.direction[i].z;
        return rays.origin[i] + t * rays.direction[i];
    };
    constexpr size_t RINGS = 32;
    std::vector<double> rings(RINGS);
    double apart = 0;
    for (size_t i = 0; i < lens.origin.size(); i++) {
        const glm::dvec3 o = lens.origin[i];
        const double r2 = (o.x * o.x + o.y * o.y) / (0.25 * 0.25);
        REQUIRE((r2 <= 1 + 1e-6 && o.z == 0));
        rings[std::min(size_t(r2 * RINGS), RINGS - 1)]++;
        REQUIRE(glm::length(at_depth(lens, i, 3) - at_depth(pinhole, i, 3)) < 1e-5);
        apart = std::max(apart, glm::length(at_depth(lens, i, 6) - at_depth(pinhole, i, 6)));
    }
    CHECK(apart == Approx(0.25).epsilon(1e-2)); // twice as far, blurred by the lens's radius
    const std::vector<double> expected(RINGS, double(lens.origin.size()) / RINGS);
    CHECK(chi_square_failure(rings, expected, 1e-4) == "");
}

TEST_CASE("camera rays have the same bits at every width") {
    Scene scene = scene_with_a_speck();
    scene.cameras.push_back(wide_camera());
    scene.cameras[0].aperture_radius = 0.1f;
    Columns in(2);
    for (uint32_t i = 0; i < 4096; i++) {
        in[0].push_back(word(i % 64 | (i / 64) << 16));
        in[1].push_back(word(i * 7));
    }
    SceneProbe scalar(scene, {"camera"});
    const Columns one = scalar.run("camera", in, 6);
    for (uint32_t width : {8u, 16u}) {
        SceneProbe wide(scene, {"camera"}, width);
        CHECK(first_bit_difference(wide.run("camera", in, 6), one) == "");
    }
}

TEST_CASE("a lens of blades is open where its corners say, evenly") {
    Camera camera = wide_camera();
    camera.aperture_radius = 0.5f;
    camera.aperture_rotation = 0.3f;
    for (const uint32_t blades : {3u, 6u, 9u}) {
        camera.aperture_blades = blades;
        INFO(blades << " blades");
        const Rays rays = picture(camera, Filter::box);
        const double inner = 0.5 * std::cos(M_PI / blades);
        double squares = 0;
        glm::dvec3 mean(0);
        for (const glm::dvec3& at : rays.origin) {
            for (uint32_t k = 0; k < blades; k++) { // each side's middle faces this way
                const double angle =
                    double(camera.aperture_rotation) + (k + 0.5) * 2 * M_PI / blades;
                REQUIRE(at.x * std::cos(angle) + at.y * std::sin(angle) < inner + 1e-6);
            }
            squares += at.x * at.x + at.y * at.y;
            mean += at;
        }
        const auto count = double(rays.origin.size());
        CHECK(glm::length(mean) / count < 2e-3);
        // Of a regular polygon, about its middle.
        CHECK(squares / count ==
              Approx(0.25 / 6 * (2 + std::cos(2 * M_PI / blades))).epsilon(0.01));
    }
}
