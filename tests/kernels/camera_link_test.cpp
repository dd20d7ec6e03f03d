// Links from points to the camera: the inverse of camera rays, and the filter's share of each
// pixel.
#include "kernels/scene_probe.h"
#include "render/filter.h"

#include <catch2/catch.hpp>

#include <map>

using namespace onde;
using namespace onde::test;

namespace {

constexpr uint32_t WIDTH = 200, HEIGHT = 100;

Scene seen_by(bool orthographic) {
    Scene scene = scene_with_a_speck();
    Camera camera;
    camera.vertical_fov = 1.2f;
    camera.focus_distance = 3;
    if (orthographic) camera.orthographic_height = 4;
    scene.cameras.push_back(camera);
    return scene;
}

RenderOptions options_of(Filter filter) {
    RenderOptions options;
    options.width = WIDTH;
    options.height = HEIGHT;
    options.filter = filter;
    return options;
}

struct Links {
    Columns in{5}, out;

    void add(glm::dvec3 p) {
        for (int k = 0; k < 3; k++) in[size_t(k)].push_back(float(p[k]));
        for (size_t k = 3; k < 5; k++) in[k].push_back(0.3f);
    }
};

/// Points before a camera at the origin that looks along -Z.
std::vector<glm::dvec3> points() {
    std::vector<glm::dvec3> points;
    for (int x = -3; x <= 3; x++)
        for (int y = -2; y <= 2; y++)
            for (int z = 1; z <= 3; z++) points.push_back({0.35 * x * z, 0.2 * y * z, -1.3 * z});
    return points;
}

/// Where a point lands on the film, in pixels, y downward.
glm::dvec2 on_film(glm::dvec3 p, bool orthographic) {
    const double scale = orthographic ? HEIGHT / 4.0 : HEIGHT / (2 * std::tan(0.6)) / -p.z;
    return {WIDTH / 2.0 + p.x * scale, HEIGHT / 2.0 - p.y * scale};
}

/// The density of filter offsets, which is constant between the knots of their table.
double density(const std::array<float, FILTER_TABLE_SIZE>& table, double offset) {
    for (size_t i = 0; i + 1 < table.size(); i++)
        if (table[i] <= offset && offset < table[i + 1])
            return 1 / (double(table.size() - 1) * (double(table[i + 1]) - table[i]));
    return 0;
}

} // namespace

TEST_CASE("a point's link leads to where the point is seen, and knows how large it is there") {
    for (bool orthographic : {false, true}) {
        INFO("orthographic " << orthographic);
        SceneProbe probe(seen_by(orthographic), {"camera_link"}, 1, options_of(Filter::box));
        Links links;
        const std::vector<glm::dvec3> at = points();
        for (const glm::dvec3& p : at) links.add(p);
        links.out = probe.run("camera_link", links.in, 7);
        const auto place_error = [&](size_t i) {
            const glm::dvec2 expected = on_film(at[i], orthographic);
            return std::max(std::abs(links.out[3][i] - expected.x),
                            std::abs(links.out[4][i] - expected.y));
        };
        CHECK(worst_item(at.size(), 1e-3, place_error, [&](size_t i) {
                  return fmt::format("({}, {})", links.out[3][i], links.out[4][i]);
              }) == "");
        const auto size_error = [&](size_t i) {
            const glm::dvec3 d = vector_at(links.out, 0, i);
            const glm::dvec3 s = glm::normalize(glm::cross(d, glm::dvec3(0.1, 1, 0.2)));
            const glm::dvec3 t = glm::cross(d, s);
            constexpr double STEP = 1e-5;
            const auto film = [&](glm::dvec3 p) { return on_film(p, orthographic); };
            const glm::dvec2 a = (film(at[i] + STEP * s) - film(at[i] - STEP * s)) / (2 * STEP);
            const glm::dvec2 b = (film(at[i] + STEP * t) - film(at[i] - STEP * t)) / (2 * STEP);
            return std::abs(links.out[5][i] / std::abs(a.x * b.y - a.y * b.x) - 1);
        };
        CHECK(worst_item(at.size(), 1e-4, size_error, [&](size_t i) {
                  return fmt::format("importance {}", links.out[5][i]);
              }) == "");
        for (size_t i = 0; i < at.size(); i++) {
            const glm::dvec2 film = on_film(at[i], orthographic);
            REQUIRE((links.out[6][i] != 0) ==
                    (film.x > -2 && film.x < WIDTH + 2 && film.y > -2 && film.y < HEIGHT + 2));
        }
    }
}

TEST_CASE("points behind the camera have no link") {
    for (bool orthographic : {false, true}) {
        SceneProbe probe(seen_by(orthographic), {"camera_link"}, 1, options_of(Filter::box));
        Links links;
        for (const glm::dvec3& p : points()) links.add({p.x, p.y, -p.z});
        const Columns out = probe.run("camera_link", links.in, 7);
        CHECK(std::ranges::count(out[6], 0.0f) == std::ptrdiff_t(out[6].size()));
    }
}

TEST_CASE("each pixel gets the share that its filter has at the point") {
    constexpr uint32_t DRAWS = 4096;
    for (Filter filter : {Filter::box, Filter::tent, Filter::gaussian, Filter::blackman_harris}) {
        INFO("filter " << uint32_t(filter));
        SceneProbe probe(seen_by(false), {"choose_pixel"}, 1, options_of(filter));
        const auto table = filter_table(filter);
        for (float x : {7.5f, 7.03f, 7.31f, 7.62f, 7.97f}) {
            Columns in(2);
            for (uint32_t i = 0; i < DRAWS; i++) {
                in[0].push_back(x);
                in[1].push_back((float(i) + 0.5f) / DRAWS);
            }
            const Columns out = probe.run("choose_pixel", in, 2);
            std::map<int, double> share;
            for (size_t i = 0; i < DRAWS; i++) share[int(out[0][i])] += out[1][i] / DRAWS;
            for (int pixel = 5; pixel <= 9; pixel++) {
                INFO("pixel " << pixel << " from " << x);
                CHECK(share[pixel] ==
                      Approx(density(table, double(x) - pixel - 0.5)).margin(2.0 / DRAWS));
            }
        }
    }
}

TEST_CASE("links have the same bits at every width") {
    Scene scene = seen_by(false);
    scene.cameras[0].aperture_radius = 0.2f;
    Links links;
    for (const glm::dvec3& p : points()) links.add(p);
    Columns draws(2);
    for (uint32_t i = 0; i < 500; i++) {
        draws[0].push_back(float(i) * 0.37f);
        draws[1].push_back(float(i) / 500);
    }
    const std::vector<std::string> names{"camera_link", "choose_pixel"};
    const RenderOptions options = options_of(Filter::blackman_harris);
    SceneProbe scalar(scene, names, 1, options);
    for (uint32_t width : {8u, 16u}) {
        SceneProbe wide(scene, names, width, options);
        CHECK(first_bit_difference(wide.run("camera_link", links.in, 7),
                                   scalar.run("camera_link", links.in, 7)) == "");
        CHECK(first_bit_difference(wide.run("choose_pixel", draws, 2),
                                   scalar.run("choose_pixel", draws, 2)) == "");
    }
}
