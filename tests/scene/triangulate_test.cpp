// Polygons become as many triangles as they must, of the same area, in time that grows little
// faster than their corners.
#include "scene/triangulate.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

using namespace onde;

namespace {

using Outline = std::vector<glm::dvec3>;

std::vector<std::array<uint32_t, 3>> triangles_of(const Outline& outline) {
    std::vector<uint32_t> corners(outline.size());
    std::iota(corners.begin(), corners.end(), 0u);
    return triangulate({outline, corners});
}

double cross(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area(const Outline& p) {
    double sum = 0.0;
    for (size_t i = 2; i < p.size(); ++i) sum += 0.5 * cross(p[0], p[i - 1], p[i]);
    return sum;
}

/// A polygon about the origin, of that radius at each corner.
Outline star(size_t corners, const std::function<double(size_t)>& radius) {
    Outline polygon;
    for (size_t i = 0; i < corners; ++i) {
        const double angle = 6.283185307179586 * double(i) / double(corners);
        const double r = radius(i);
        polygon.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    return polygon;
}

/// A band that winds inward and back.
Outline spiral(size_t corners) {
    Outline polygon;
    const auto point = [&](size_t i, double inward) {
        const double t = double(i) / double(corners / 2), angle = 40.0 * 6.283185307179586 * t;
        const double radius = 2.0 - t - inward * 0.01;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    };
    for (size_t i = 0; i < corners / 2; ++i) point(i, 0.0);
    for (size_t i = corners / 2; i > 0; --i) point(i - 1, 1.0);
    return polygon;
}

/// Teeth on a bar.
Outline comb(size_t corners) {
    Outline polygon{{0.0, -1.0, 0.0}, {double(corners), -1.0, 0.0}};
    for (size_t i = corners - 2; i > 0; --i)
        polygon.emplace_back(double(i), i % 2 ? 1000.0 : 0.0, 0.0);
    return polygon;
}

/// Checks the triangles of a simple, counter-clockwise polygon; returns the seconds they took.
double check_simple(const Outline& polygon) {
    const auto start = std::chrono::steady_clock::now();
    const auto triangles = triangles_of(polygon);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    CHECK(triangles.size() == polygon.size() - 2);
    double sum = 0.0;
    size_t turned = 0;
    for (const auto& [a, b, c] : triangles) {
        const double twice = cross(polygon[a], polygon[b], polygon[c]);
        sum += 0.5 * std::abs(twice);
        turned += twice < -1e-9;
    }
    CHECK(turned == 0);
    CHECK(sum == Approx(area(polygon)).epsilon(1e-9));
    return took.count();
}

} // namespace

TEST_CASE("simple polygons keep their area and their winding") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.1, 1.0);
    for (size_t corners = 3; corners < 60; ++corners) {
        INFO(corners);
        check_simple(star(corners, [&](size_t) { return radius(random); }));
        check_simple(star(corners, [&](size_t i) { return i % 2 ? 1.0 : 0.4; }));
    }
    check_simple(spiral(1000));
    check_simple(comb(1000));
}

TEST_CASE("a square with a hole, joined by a bridge, keeps its area") {
    const Outline keyhole{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                          {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    check_simple(keyhole);
    Outline clockwise(keyhole.rbegin(), keyhole.rend()); // seen from behind
    for (glm::dvec3& p : clockwise) p.x = -p.x;
    check_simple(clockwise);
}

TEST_CASE("hostile polygons of 100,000 corners take a second or two") {
    constexpr size_t CORNERS = 100000;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.01, 1.0);
    const double limit = 20.0; // machines under sanitizers or load are slow; cubic took hours
    CHECK(check_simple(star(CORNERS, [](size_t i) { return i % 2 ? 1.0 : 0.5; })) < limit);
    CHECK(check_simple(star(CORNERS, [&](size_t) { return radius(random); })) < limit);
    CHECK(check_simple(spiral(CORNERS)) < limit);
    CHECK(check_simple(comb(CORNERS)) < limit);
}

TEST_CASE("polygons that cross or touch themselves everywhere become triangles in time") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(0.0, 1.0);
    Outline tangle, fan, line;
    for (size_t i = 0; i < 100000; ++i) {
        tangle.emplace_back(anywhere(random), anywhere(random), 0.0);
        fan.emplace_back(i % 2 ? glm::dvec3(0.0) : tangle.back());
        line.emplace_back(double(i % 7), 0.0, 0.0);
    }
    for (const Outline& polygon : {tangle, fan, line}) {
        const auto start = std::chrono::steady_clock::now();
        CHECK(triangles_of(polygon).size() == polygon.size() - 2);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        CHECK(took.count() < 20.0);
    }
}

TEST_CASE("a polygon of far more corners than positions is cut without looking for ears") {
    const Outline square{{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}};
    std::vector<uint32_t> corners(3000000);
    for (size_t i = 0; i < corners.size(); ++i) corners[i] = uint32_t(i % square.size());
    const auto start = std::chrono::steady_clock::now();
    CHECK(triangulate({square, corners}).size() == corners.size() - 2);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    CHECK(took.count() < 5.0);
}
