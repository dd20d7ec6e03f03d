// The chapter's recursion against what can be said in closed form.
#include "support/chapter/eye.h"
#include "support/chapter/trace.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <random>

using namespace onde;
using namespace onde::chapter;
using glm::dvec3;

namespace {

/// Zero on the canonical shape's surface and of another sign on each side of it.
double implicit(ShapeKind kind, double minor_radius, const dvec3& p) {
    const double rho = std::hypot(p.x, p.z);
    switch (kind) {
    case ShapeKind::cylinder:
        return std::max(rho, std::abs(p.y)) - 1;
    case ShapeKind::cone:
        return std::max(rho + p.y - 1, -p.y);
    case ShapeKind::torus:
        return std::hypot(rho - 1, p.y) - minor_radius;
    default:
        return glm::length(p) - 1;
    }
}

/// A square in the plane y = `height` that looks up, of the material of that index.
void add_square(Scene& scene, float height, uint32_t material) {
    Mesh square;
    square.positions = {{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}};
    square.triangles = {{0, 2, 1}, {0, 3, 2}};
    square.materials = {material, material};
    scene.meshes.push_back(square);
    scene.instances.push_back(
        {uint32_t(scene.meshes.size() - 1), glm::translate(glm::mat4(1), {0.0f, height, 0.0f})});
}

} // namespace

TEST_CASE("a polynomial's roots are found in order, whatever lies between them") {
    // (x + 2)(x + 1)(x - 1/2)(x - 3)
    const Roots four = roots({3, -2.5, -7, -0.5, 1}, -10, 10);
    REQUIRE(four.count == 4);
    const double expected[] = {-2, -1, 0.5, 3};
    for (int i = 0; i < 4; ++i) CHECK(four.values[i] == Approx(expected[i]).epsilon(1e-14));
    CHECK(roots({1, 0, 1}, -10, 10).count == 0);
    CHECK(roots({3, -2.5, -7, -0.5, 1}, 0, 1).count == 1);
}

TEST_CASE("every crossing lies on its shape, and a line enters as often as it leaves") {
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    const auto point = [&] {
        return dvec3(normal(generator), normal(generator), normal(generator));
    };
    for (const ShapeKind kind :
         {ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::cone, ShapeKind::torus})
        for (const double minor_radius : {0.1, 0.5}) {
            size_t crossings = 0;
            for (int i = 0; i < 20000; ++i) {
                const Ray ray{5.0 * point(), point()};
                const Ray aimed{ray.origin, 0.7 * ray.direction - ray.origin};
                const Crossings found = cross_shape(kind, minor_radius, aimed);
                REQUIRE(found.count % 2 == 0);
                int entered = 0;
                for (const Crossing& crossing : found) {
                    const dvec3 p = aimed.at(crossing.t);
                    CHECK(std::abs(implicit(kind, minor_radius, p)) < 1e-10);
                    const dvec3 out = 1e-6 * glm::normalize(crossing.normal);
                    CHECK(implicit(kind, minor_radius, p + out) > 0);
                    entered += glm::dot(crossing.normal, aimed.direction) < 0 ? 1 : -1;
                }
                CHECK(entered == 0);
                crossings += size_t(found.count);
            }
            CHECK(crossings > 5000);
        }
}

TEST_CASE("the first sample is the pixel's centre, and pixels ascend downward") {
    CHECK(r2_sample(0) == glm::dvec2(0.5));
    Camera camera;
    camera.screen = ScreenWindow{{4, 2}, 3, {}};
    const Ray ray = camera_ray(camera, {40, 20}, {30, 5});
    CHECK(glm::length(ray.direction / -ray.direction.z - dvec3(1.0 / 3, 0.5 / 3, -1)) < 1e-15);
}

TEST_CASE("white light is whole again after it has been split") {
    for (const uint32_t count : {3u, 7u, 16u}) {
        dvec3 sum(0);
        for (const Wavelength& wavelength : split_white(count)) sum += wavelength.filter;
        CHECK(glm::length(sum - 1.0) < 1e-14);
    }
    const double at_f = refractive_index(1.5, 30, 0.4861), at_c = refractive_index(1.5, 30, 0.6563);
    CHECK((refractive_index(1.5, 30, 0.5876) - 1) / (at_f - at_c) == Approx(30));
}

TEST_CASE("under water the sky is a disk as wide as the critical angle, and the rest mirrors") {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].ior = 1.33f;
    scene.chapter.phong[0] = {.ambient = 0, .diffuse = 0, .transmission = 0.9f};
    scene.materials[1].base_color = glm::vec3(0.25f);
    scene.chapter.whitted.ambient = glm::vec3(1);
    scene.chapter.whitted.background = glm::vec3(0.5f);
    add_square(scene, 0, 0);
    add_square(scene, -1, 1);
    Camera camera; // looks straight up from below the surface
    camera.camera_to_world = glm::mat4({1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, -0.5f, 0, 1});
    camera.vertical_fov = 2.4f;
    scene.cameras = {camera};
    const Tracer tracer(scene, 4);
    const double focal = 500 / std::tan(1.2);
    const double edge = focal * std::tan(std::asin(1 / 1.33));
    const auto seen = [&](double x) {
        return tracer.sample({1000, 1000}, {500 + x, 500}, 0).colour;
    };
    CHECK(seen(edge - 0.01).x == Approx(0.9 * 0.5));
    CHECK(seen(edge + 0.01).x == Approx(0.9 * 0.25));
    const Tracer shallow(scene, 1);
    CHECK(shallow.sample({1000, 1000}, {500, 500}, 0).colour.x == 0);
}

TEST_CASE("light that falls on a surface is what the formula says, behind a pane as well") {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].base_color = {0.5f, 0.25f, 1};
    scene.chapter.phong[0] = {.ambient = 0, .diffuse = 0.75f, .specular = 0.5f, .exponent = 2};
    scene.chapter.phong[1].transmission = 0.5f;
    scene.point_lights = {{.position = {0, 3, 3}}};
    scene.chapter.intensities.point_lights[0] = glm::vec3(0.5f);
    Camera camera; // looks down at the origin from (0, 2, 0)
    camera.camera_to_world = glm::mat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 2, 0, 1});
    scene.cameras = {camera};
    add_square(scene, 0, 0);
    const auto seen = [&] { return Tracer(scene, 1).sample({2, 2}, {1, 1}, 0).colour; };
    const dvec3 free = seen();
    const double expected = 0.5 * 0.5 * (0.75 * std::sqrt(0.5) + 0.5 * 0.5);
    CHECK(free.x == Approx(expected));
    CHECK(free.z == Approx(2 * expected));
    add_square(scene, 2.5f, 1);
    CHECK(seen().x == Approx(0.5 * expected));
}
