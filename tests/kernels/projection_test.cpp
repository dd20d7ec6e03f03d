// Panoramas and fisheyes: rays against closed forms, links as their inverse, and the solid angle of
// a pixel.
#include "kernels/scene_probe.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <numbers>

using namespace onde;
using namespace onde::test;

namespace {

constexpr uint32_t WIDTH = 200, HEIGHT = 100;
constexpr double PI = std::numbers::pi;
const Projection WIDE[] = {Projection::panorama, Projection::fisheye};

Camera camera_of(Projection projection) {
    Camera camera;
    camera.projection = projection;
    camera.fisheye_angle = float(PI * 200 / 180);
    camera.camera_to_world = glm::rotate(glm::translate(glm::mat4(1), glm::vec3(0.3f, -0.2f, 0.5f)),
                                         0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    return camera;
}

SceneProbe probe_of(const Camera& camera, const std::string& name) {
    Scene scene = scene_with_a_speck();
    scene.cameras.push_back(camera);
    RenderOptions options;
    options.width = WIDTH;
    options.height = HEIGHT;
    options.filter = Filter::box;
    return SceneProbe(scene, {name}, 1, options);
}

glm::dvec3 in_world(const Camera& camera, const glm::dvec3& d) {
    return glm::dmat3(glm::dmat4(camera.camera_to_world)) * d;
}

/// The direction of a place on the film, in the space of the camera, which looks along -Z.
glm::dvec3 expected_direction(Projection projection, double x, double y) {
    if (projection == Projection::panorama) {
        const double along = 2 * PI * (x / WIDTH - 0.5), up = PI * (0.5 - y / HEIGHT);
        return {std::sin(along) * std::cos(up), std::sin(up), -std::cos(along) * std::cos(up)};
    }
    const double right = x - WIDTH / 2.0, above = HEIGHT / 2.0 - y, r = std::hypot(right, above);
    const double angle = r / (HEIGHT / 2.0) * (PI * 100 / 180);
    if (r == 0) return {0, 0, -1};
    return {right / r * std::sin(angle), above / r * std::sin(angle), -std::cos(angle)};
}

/// Places on the film; inside of the circle of a fisheye.
std::vector<glm::dvec2> places(Projection projection) {
    std::vector<glm::dvec2> all;
    for (int i = 0; i < 23; i++)
        for (int k = 0; k < 19; k++) {
            const glm::dvec2 at((i + 0.5) / 23 * WIDTH, (k + 0.5) / 19 * HEIGHT);
            const bool inside = glm::length(at - glm::dvec2(WIDTH, HEIGHT) / 2.0) < HEIGHT / 2.0;
            if (inside || projection == Projection::panorama) all.push_back(at);
        }
    return all;
}

Columns columns_of(const std::vector<glm::dvec2>& at) {
    Columns in(2);
    for (const glm::dvec2& p : at) {
        in[0].push_back(float(p.x));
        in[1].push_back(float(p.y));
    }
    return in;
}

/// Links of points at a distance in these directions of the world.
Columns links_of(const Camera& camera, const std::vector<glm::dvec3>& directions, double distance) {
    SceneProbe probe = probe_of(camera, "camera_link");
    Columns in(5);
    for (const glm::dvec3& d : directions) {
        const glm::dvec3 p = glm::dvec3(camera.camera_to_world[3]) + distance * d;
        for (int k = 0; k < 3; k++) in[size_t(k)].push_back(float(p[k]));
        for (size_t k = 3; k < 5; k++) in[k].push_back(0.3f);
    }
    return probe.run("camera_link", in, 7);
}

/// Of places on the film, in the world.
std::vector<glm::dvec3> directions_at(const Camera& camera, const std::vector<glm::dvec2>& at) {
    std::vector<glm::dvec3> directions;
    for (const glm::dvec2& p : at)
        directions.push_back(in_world(camera, expected_direction(camera.projection, p.x, p.y)));
    return directions;
}

} // namespace

TEST_CASE("a place on the film of a panorama or fisheye has the ray of the closed form") {
    for (const Projection projection : WIDE) {
        const Camera camera = camera_of(projection);
        const std::vector<glm::dvec2> at = places(projection);
        SceneProbe probe = probe_of(camera, "ray_through");
        const Columns out = probe.run("ray_through", columns_of(at), 6);
        const auto error = [&](size_t i) {
            const glm::dvec3 d = in_world(camera, expected_direction(projection, at[i].x, at[i].y));
            return glm::length(vector_at(out, 3, i) - d) +
                   glm::length(vector_at(out, 0, i) - glm::dvec3(camera.camera_to_world[3]));
        };
        INFO(word_of(projection));
        CHECK(worst_item(at.size(), 2e-6, error, [&](size_t i) {
                  return fmt::format("({}, {})", at[i].x, at[i].y);
              }) == "");
    }
}

TEST_CASE("links of panoramas and fisheyes lead back to where the ray came from") {
    for (const Projection projection : WIDE) {
        const Camera camera = camera_of(projection);
        const std::vector<glm::dvec2> at = places(projection);
        const std::vector<glm::dvec3> directions = directions_at(camera, at);
        const Columns out = links_of(camera, directions, 2.5);
        const auto error = [&](size_t i) {
            return std::max(std::abs(out[3][i] - at[i].x), std::abs(out[4][i] - at[i].y)) +
                   glm::length(vector_at(out, 0, i) + directions[i]);
        };
        INFO(word_of(projection));
        CHECK(worst_item(at.size(), 1e-3, error, [&](size_t i) {
                  return fmt::format("({}, {})", out[3][i], out[4][i]);
              }) == "");
        for (size_t i = 0; i < at.size(); i++) REQUIRE(out[6][i] != 0);
    }
}

TEST_CASE(
    "a link's importance is one over the solid angle of a pixel, and the square of distance") {
    // Of a panorama 2 pi / W * pi / H * cos(latitude); of a fisheye sin(angle) d angle d turn.
    for (const Projection projection : WIDE) {
        const Camera camera = camera_of(projection);
        const std::vector<glm::dvec2> at = places(projection);
        const std::vector<glm::dvec3> directions = directions_at(camera, at);
        const Columns out = links_of(camera, directions, 2.5);
        const auto solid_angle = [&](const glm::dvec2& p) {
            if (projection == Projection::panorama)
                return 2 * PI / WIDTH * PI / HEIGHT * std::cos(PI * (0.5 - p.y / HEIGHT));
            const double r = glm::length(p - glm::dvec2(WIDTH, HEIGHT) / 2.0);
            const double step = (PI * 100 / 180) / (HEIGHT / 2.0);
            return r > 0 ? std::sin(r * step) * step / r : step * step;
        };
        const auto error = [&](size_t i) {
            return std::abs(out[5][i] * solid_angle(at[i]) * 2.5 * 2.5 - 1);
        };
        INFO(word_of(projection));
        CHECK(worst_item(at.size(), 2e-4, error, [&](size_t i) {
                  return fmt::format("importance {} at ({}, {})", out[5][i], at[i].x, at[i].y);
              }) == "");
    }
}

TEST_CASE("a fisheye has no links to what lies outside of its circle") {
    const Camera camera = camera_of(Projection::fisheye);
    std::vector<glm::dvec3> directions;
    for (const double degrees : {99.0, 101.0, 150.0, 179.0})
        directions.push_back(
            in_world(camera, {std::sin(degrees * PI / 180), 0, -std::cos(degrees * PI / 180)}));
    const Columns out = links_of(camera, directions, 1);
    CHECK(out[6][0] != 0);
    for (size_t i = 1; i < directions.size(); i++) CHECK(out[6][i] == 0);
}
