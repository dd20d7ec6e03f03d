// Textures, normal maps, the camera and its filter.
#include "support/reference/camera.h"
#include "support/reference/material.h"
#include "support/reference/scenes.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::reference;

namespace {

/// Grey texels in a row.
Texture row(std::vector<uint8_t> codes, Wrap wrap, bool srgb) {
    Texture texture;
    texture.srgb = srgb;
    texture.wrap_u = wrap;
    texture.wrap_v = Wrap::clamp;
    texture.image.width = uint32_t(codes.size());
    texture.image.height = 1;
    for (const uint8_t code : codes)
        texture.image.rgba.insert(texture.image.rgba.end(), {code, code, code, 255});
    return texture;
}

float at(const Texture& texture, float u) {
    return TextureMap(texture, texture.image).sample({u, 0.3f}).g;
}

Scene with_normal_map(uint8_t r, uint8_t g, uint8_t b, float scale) {
    Scene scene;
    Texture texture = row({0}, Wrap::repeat, false);
    texture.image.rgba = {r, g, b, 255};
    scene.textures = {texture};
    scene.materials = {diffuse(glm::vec3(0.5f))};
    scene.materials[0].normal_texture = 0;
    scene.materials[0].normal_scale = scale;
    return scene;
}

double standard_deviation(Filter filter) {
    const PixelFilter pixel_filter(filter);
    double sum = 0.0;
    constexpr uint32_t COUNT = 100000;
    for (uint32_t i = 0; i < COUNT; ++i) {
        const double x = double(pixel_filter.sample((float(i) + 0.5f) / COUNT));
        sum += x * x / COUNT;
    }
    return std::sqrt(sum);
}

} // namespace

TEST_CASE("texels are interpolated between their centres and wrap as asked") {
    const std::vector<uint8_t> codes = {0, 51, 102, 255};
    CHECK(at(row(codes, Wrap::repeat, false), 0.375f) == Approx(0.2f));
    CHECK(at(row(codes, Wrap::repeat, false), 0.5f) == Approx(0.3f));
    CHECK(at(row(codes, Wrap::repeat, false), 0.0f) == Approx(0.5f));
    CHECK(at(row(codes, Wrap::repeat, false), -1.625f) == Approx(0.2f));
    CHECK(at(row(codes, Wrap::clamp, false), 0.0f) == Approx(0.0f));
    CHECK(at(row(codes, Wrap::clamp, false), 7.0f) == Approx(1.0f));
    CHECK(at(row(codes, Wrap::mirror, false), 1.0f) == Approx(1.0f));
    CHECK(at(row(codes, Wrap::mirror, false), 1.625f) == Approx(0.2f));
    CHECK(at(row(codes, Wrap::mirror, false), -0.375f) == Approx(0.2f));
}

TEST_CASE("sRGB codes are decoded before they are interpolated") {
    CHECK(srgb_to_linear(188) == Approx(0.5028865));
    CHECK(srgb_to_linear(10) == Approx(10.0 / 255.0 / 12.92));
    CHECK(at(row({0, 255}, Wrap::clamp, true), 0.5f) == Approx(0.5f));
}

TEST_CASE("a normal map bends along u with red and against v with green") {
    const glm::vec3 normal(0, 0, 1);
    const Tangents tangents{{2, 0, 0}, {0, -3, 0}}; // v downward in the picture, +Y up
    const auto bent = [&](uint8_t r, uint8_t g, float scale) {
        const Appearance appearance(with_normal_map(r, g, 255, scale));
        return appearance.mapped_normal(appearance.material(0), {}, tangents, normal);
    };
    CHECK(bent(255, 128, 1.0f).x == Approx(std::sqrt(0.5f)).epsilon(0.01));
    CHECK(bent(128, 255, 1.0f).y == Approx(std::sqrt(0.5f)).epsilon(0.01));
    CHECK(bent(255, 128, 0.5f).x == Approx(0.4472f).epsilon(0.01));
}

TEST_CASE("factors and textures multiply") {
    Scene scene;
    Texture texture = row({0}, Wrap::repeat, false);
    texture.image.rgba = {10, 51, 102, 7};
    scene.textures = {texture};
    scene.materials = {diffuse({0.5f, 1.0f, 1.0f})};
    Material& m = scene.materials[0];
    m.base_color_texture = m.metallic_roughness_texture = m.emission_texture = 0;
    m.roughness = m.metallic = 0.5f;
    m.emission = glm::vec3(10.0f);
    const Appearance appearance(scene);
    const MaterialRecord here = appearance.at(appearance.material(0), {0.2f, 0.7f});
    CHECK(here.base_color.r == Approx(0.5f * 10.0f / 255.0f));
    CHECK(here.roughness == Approx(0.5f * 0.2f));
    CHECK(here.metallic == Approx(0.5f * 0.4f));
    CHECK(appearance.emission(appearance.material(0), {}, true).b == Approx(4.0f));
}

TEST_CASE("the filters have the spread of their closed forms") {
    CHECK(standard_deviation(Filter::box) == Approx(std::sqrt(1.0 / 12.0)).epsilon(1e-3));
    CHECK(standard_deviation(Filter::tent) == Approx(std::sqrt(1.0 / 6.0)).epsilon(1e-3));
    // A Gaussian cut at k = 3 sigma: variance sigma^2 (1 - 2 k phi(k) / (2 Phi(k) - 1)).
    CHECK(standard_deviation(Filter::gaussian) == Approx(0.5 * std::sqrt(0.97334)).epsilon(1e-3));
    // Integrals of x^2 cos(2 pi n x / 3) over the radius, over those of the window.
    const double a0 = 0.35875, a1 = 0.48829, a2 = 0.14128, a3 = 0.01168, r2 = 2.25;
    const double pi2 = M_PI * M_PI;
    const double variance = r2 * (a0 / 3.0 - 2.0 / pi2 * (a1 - a2 / 4.0 + a3 / 9.0)) / a0;
    CHECK(standard_deviation(Filter::blackman_harris) == Approx(std::sqrt(variance)).epsilon(2e-3));
}

TEST_CASE("the camera sees -Z, y downward, with its field of view over the film's height") {
    Camera camera;
    camera.vertical_fov = 1.0f;
    const PinholeOrLens lens(camera, 200, 100, Filter::box);
    Random random(0, 0, 0);
    glm::dvec3 corner(0.0);
    for (uint32_t i = 0; i < 10000; ++i) {
        const glm::vec3 d = lens.sample(0, 0, random).direction;
        corner += glm::dvec3(d / -d.z) / 10000.0;
    }
    const double half_height = std::tan(0.5);
    CHECK(corner.y == Approx(half_height * 0.99).epsilon(1e-3));
    CHECK(corner.x == Approx(-half_height * 1.99).epsilon(1e-3));
}

TEST_CASE("rays through a thin lens meet on the plane of focus") {
    Camera camera = look_at({1, 2, 3}, {1, 2, -7}, 0.001f);
    camera.aperture_radius = 0.5f;
    camera.focus_distance = 4.0f;
    const PinholeOrLens lens(camera, 1, 1, Filter::box);
    Random random(0, 0, 0);
    double spread = 0.0;
    for (uint32_t i = 0; i < 1000; ++i) {
        const Ray ray = lens.sample(0, 0, random);
        const glm::vec3 focus = ray.origin + ray.direction * (4.0f / -ray.direction.z);
        CHECK(glm::length(focus - glm::vec3(1, 2, -1)) < 0.004f);
        spread += double(glm::length(ray.origin - glm::vec3(1, 2, 3))) / 1000.0;
    }
    CHECK(spread == Approx(0.5 * 2.0 / 3.0).epsilon(0.05)); // the mean radius of a disk
}
