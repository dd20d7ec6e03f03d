// Direct light on a diffuse floor, against closed forms.
#include "support/reference/reference.h"
#include "support/reference/scenes.h"

#include <catch2/catch.hpp>

#include <array>

using namespace onde;
using namespace onde::reference;

namespace {

constexpr float ALBEDO = 0.6f;
constexpr float PI_F = 3.14159265f;

/// A floor at y = 0 seen from above through a fov so narrow that all pixels see the origin.
Scene floor_at_origin() {
    Scene scene;
    scene.materials = {diffuse(glm::vec3(ALBEDO))};
    add_mesh(scene, parallelogram({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, 0));
    scene.cameras = {look_at({4, 1, 0}, {0, 0, 0}, 1e-3f)};
    return scene;
}

/// Irradiance at the origin with normal +Y of a polygon of radiance 1 above the horizon, its
/// corners clockwise seen from the origin (Lambert 1760; Baum et al. 1989, equation 5).
template <size_t N>
double polygon_irradiance(const std::array<glm::dvec3, N>& corners) {
    double sum = 0.0;
    for (size_t i = 0; i < N; ++i) {
        const glm::dvec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % N]);
        const glm::dvec3 c = glm::cross(a, b);
        sum += std::acos(glm::dot(a, b)) * c.y / glm::length(c);
    }
    return 0.5 * std::abs(sum);
}

/// The mean of all pixels is within 4 standard deviations of the radiance that a diffuse floor
/// of irradiance E sends back, and known to better than `precision`.
void check_irradiance(const Scene& scene, double expected, double precision,
                      Technique technique = Technique::mis) {
    ReferenceOptions options;
    options.width = options.height = 16;
    options.samples = 512;
    options.depth = 2;
    options.technique = technique;
    const ReferenceResult result = ReferenceRenderer(scene).render(options);
    double mean = 0.0, variance = 0.0;
    for (size_t i = 0; i < result.mean.size(); ++i) {
        mean += double(result.mean[i].x) / 256.0;
        variance += double(result.variance_of_mean[i].x) / (256.0 * 256.0);
    }
    const double radiance = expected * double(ALBEDO / PI_F);
    INFO("expected " << radiance << ", found " << mean << " +- " << std::sqrt(variance));
    CHECK(std::abs(mean - radiance) < 4.0 * std::sqrt(variance) + 1e-3 * radiance);
    CHECK(std::sqrt(variance) < precision * radiance);
}

} // namespace

TEST_CASE("a square light above a floor gives Lambert's polygon formula") {
    Scene scene = floor_at_origin();
    scene.materials.push_back(emitter(glm::vec3(2.0f)));
    add_mesh(scene, parallelogram({-0.5f, 1, -1}, {2, 0, 0}, {0, 0, 1.5f}, 1)); // facing down
    const std::array<glm::dvec3, 4> corners = {
        {{-0.5, 1, -1}, {1.5, 1, -1}, {1.5, 1, 0.5}, {-0.5, 1, 0.5}}};
    const double expected = 2.0 * polygon_irradiance(corners);
    check_irradiance(scene, expected, 0.005);
    check_irradiance(scene, expected, 0.01, Technique::light_only);
    check_irradiance(scene, expected, 0.01, Technique::bsdf_only);
}

TEST_CASE("a light seen from its back face gives nothing unless it is two-sided") {
    Scene scene = floor_at_origin();
    scene.materials.push_back(emitter(glm::vec3(2.0f)));
    add_mesh(scene, parallelogram({-0.5f, 1, 0.5f}, {2, 0, 0}, {0, 0, -1.5f}, 1)); // facing up
    const std::array<glm::dvec3, 4> corners = {
        {{-0.5, 1, -1}, {1.5, 1, -1}, {1.5, 1, 0.5}, {-0.5, 1, 0.5}}};
    for (const glm::vec3& pixel : ReferenceRenderer(scene).render({.depth = 2}).mean)
        REQUIRE(pixel.x == 0.0f);
    scene.materials[1].two_sided = true;
    check_irradiance(scene, 2.0 * polygon_irradiance(corners), 0.005);
}

TEST_CASE("a point light gives intensity times cosine over distance squared") {
    Scene scene = floor_at_origin();
    scene.point_lights = {{{1, 2, -1}, glm::vec3(5.0f)}};
    const double distance2 = 6.0, cosine = 2.0 / std::sqrt(6.0);
    check_irradiance(scene, 5.0 * cosine / distance2, 0.001);
}

TEST_CASE("a directional light gives its irradiance times cosine, and shadows") {
    Scene scene = floor_at_origin();
    scene.directional_lights = {{glm::normalize(glm::vec3(1, 1, 0)), glm::vec3(3.0f)}};
    check_irradiance(scene, 3.0 * std::sqrt(0.5), 0.001);
    scene.spheres = {{{5, 5, 0.05f}, 0.1f, 0}};
    for (const glm::vec3& pixel : ReferenceRenderer(scene).render({.depth = 2}).mean)
        REQUIRE(pixel.x == 0.0f);
}

TEST_CASE("a spherical light above the horizon gives pi L (r / d)^2 cos") {
    Scene scene = floor_at_origin();
    scene.materials.push_back(emitter(glm::vec3(4.0f)));
    scene.spheres = {{{-1, 2, 0}, 0.8f, 1}};
    const double d2 = 5.0, expected = double(PI_F) * 4.0 * 0.64 / d2 * (2.0 / std::sqrt(d2));
    check_irradiance(scene, expected, 0.005);
    check_irradiance(scene, expected, 0.01, Technique::bsdf_only);
}

TEST_CASE("inside a two-sided spherical light the irradiance is pi L") {
    Scene scene = floor_at_origin();
    scene.materials.push_back(emitter(glm::vec3(4.0f)));
    scene.materials[1].two_sided = true;
    scene.spheres = {{{-1, 2, 0}, 30.0f, 1}};
    check_irradiance(scene, double(PI_F) * 4.0, 0.005);
}

TEST_CASE("several lights of very different power add up") {
    Scene scene = floor_at_origin();
    scene.point_lights = {{{0, 1, 0}, glm::vec3(5.0f)}, {{0, 2, 0}, glm::vec3(0.01f)}};
    scene.directional_lights = {{{0, 1, 0}, glm::vec3(0.3f)}};
    scene.environment.radiance = glm::vec3(0.1f);
    check_irradiance(scene, 5.0 + 0.0025 + 0.3 + 0.1 * double(PI_F), 0.1);
}
