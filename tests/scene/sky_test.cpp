// Skies of other renderers as an environment.
#include "scene/sky.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <numbers>

using namespace onde;

namespace {

constexpr double PI = std::numbers::pi;

Environment environment(std::vector<SkyLight> lights) {
    LoadContext context;
    return environment_of(std::move(lights), context, "test");
}

/// What the environment's map shows in a direction.
glm::vec3 toward(const Environment& e, glm::dvec3 d) {
    d = glm::normalize(d);
    const double turned = std::atan2(d.x, -d.z) + e.rotation;
    const double u = std::fmod(0.5 + turned / (2 * PI) + 2.0, 1.0);
    const double v = std::acos(d.y) / PI;
    const Image& map = *e.map;
    const auto pixel = map.pixel(std::min(uint32_t(u * map.width), map.width - 1),
                                 std::min(uint32_t(v * map.height), map.height - 1));
    return e.radiance * glm::vec3(pixel[0], pixel[1], pixel[2]);
}

/// 1 where the sum of the distances from the middle is below a half: toward +Z. Red toward +X,
/// green toward +Y.
SkyLight octahedral(uint32_t size = 64) {
    SkyLight light{.shape = SkyShape::octahedral, .picture = Image(size, size, 3)};
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x) {
            const double u = 2.0 * (x + 0.5) / size - 1.0, v = 2.0 * (y + 0.5) / size - 1.0;
            light.picture.pixel(x, y)[0] = u > 0.0;
            light.picture.pixel(x, y)[1] = v > 0.0;
            light.picture.pixel(x, y)[2] = std::abs(u) + std::abs(v) < 1.0;
        }
    return light;
}

void check_signs(const Environment& e, const glm::dmat3& light_to_world) {
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0}) {
                const glm::vec3 seen = toward(e, light_to_world * glm::dvec3(x, y, z));
                CHECK(seen == glm::vec3(x > 0, y > 0, z > 0));
            }
}

} // namespace

TEST_CASE("a square picture covers the sphere by octants") {
    const SkyLight light = octahedral();
    check_signs(environment({light}), glm::dmat3(1.0));
}

TEST_CASE("a square picture is turned and mirrored with its light") {
    SkyLight light = octahedral();
    light.light_to_world = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(1, 2, 3)));
    check_signs(environment({light}), light.light_to_world);
    light.light_to_world[1] = -light.light_to_world[1];
    check_signs(environment({light}), light.light_to_world);
    light.light_to_world *= 7.0; // scales change nothing
    check_signs(environment({light}), light.light_to_world);
}

TEST_CASE("equal areas of a square picture are equal solid angles") {
    SkyLight light{.shape = SkyShape::octahedral, .picture = Image(16, 16, 3)};
    light.picture.pixel(11, 3)[0] = 1.0f;
    const Environment e = environment({light});
    double sum = 0.0;
    for (uint32_t y = 0; y < e.map->height; ++y)
        for (uint32_t x = 0; x < e.map->width; ++x)
            sum += e.map->pixel(x, y)[0] * (2 * PI / e.map->width) *
                   (std::cos(PI * y / e.map->height) - std::cos(PI * (y + 1) / e.map->height));
    CHECK(sum == Approx(4 * PI / 256).epsilon(0.08));
}

TEST_CASE("an upright map stays as it is, and is turned by its rotation") {
    SkyLight light{.shape = SkyShape::equirectangular, .picture = Image(8, 4, 3)};
    light.picture.pixel(6, 1)[0] = 1.0f; // 0.75 to 0.875 of the width: right of +X
    const double angle = 0.5;
    light.light_to_world = glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 1, 0)));
    const Environment e = environment({light});
    CHECK(e.map->width == 8);
    CHECK(e.rotation == Approx(angle));
    const glm::dvec3 middle(std::sin(0.3125 * 2 * PI), 0.4, -std::cos(0.3125 * 2 * PI));
    CHECK(toward(e, light.light_to_world * middle).x == 1.0f);
}

TEST_CASE("a map that is tipped is drawn anew, and lights are added") {
    SkyLight map{
        .radiance = glm::vec3(2.0f), .shape = SkyShape::equirectangular, .picture = Image(8, 4, 3)};
    for (uint32_t x = 0; x < 8; ++x)
        for (uint32_t y = 0; y < 2; ++y) map.picture.pixel(x, y)[1] = 1.0f; // above
    map.light_to_world = glm::dmat3(glm::rotate(glm::dmat4(1.0), PI / 2, glm::dvec3(1, 0, 0)));
    const SkyLight grey{.radiance = glm::vec3(0.25f)};
    const Environment e = environment({grey, map, grey});
    CHECK(toward(e, {0.1, 0.2, 1}) == glm::vec3(0.5f, 2.5f, 0.5f)); // +Y has become +Z
    CHECK(toward(e, {0.1, 0.2, -1}) == glm::vec3(0.5f));
}

TEST_CASE("lights without a picture need no map") {
    const Environment e = environment({{.radiance = {1, 2, 3}}, {.radiance = {1, 0, 0}}});
    CHECK_FALSE(e.map);
    CHECK(e.radiance == glm::vec3(2, 2, 3));
}
