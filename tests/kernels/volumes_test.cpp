// Bounding volumes (C12): they are tight, and no ray that hits the object is rejected by one.
#include "accel/soups.h"
#include "chapter/random_lines.h"
#include "chapter/volume_trials.h"
#include "kernels/columns.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

namespace {

TriangleSoup soup_of(const Soup& soup) {
    return {soup.positions, soup.triangles};
}

/// A ball of many triangles, stretched and turned.
TriangleSoup ellipsoid(glm::vec3 size, float turn) {
    constexpr uint32_t RINGS = 24;
    TriangleSoup soup;
    const glm::mat3 rotation(
        glm::rotate(glm::mat4(1.0f), turn, glm::normalize(glm::vec3(1, 2, 3))));
    for (uint32_t i = 0; i <= RINGS; ++i)
        for (uint32_t j = 0; j < 2 * RINGS; ++j) {
            const float a = float(M_PI) * float(i) / RINGS, b = float(M_PI) * float(j) / RINGS;
            const glm::vec3 p(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
            soup.positions.push_back(rotation * (size * p));
            const uint32_t here = i * 2 * RINGS + j;
            const uint32_t right = i * 2 * RINGS + (j + 1) % (2 * RINGS);
            if (i == RINGS) continue;
            soup.triangles.emplace_back(here, here + 2 * RINGS, right);
            soup.triangles.emplace_back(right, here + 2 * RINGS, right + 2 * RINGS);
        }
    return soup;
}

VolumeTester tester_of(const FittedVolumes& volumes, uint32_t width) {
    return VolumeTester(programs(), volumes, width);
}

std::vector<glm::vec3> cloud(size_t count, unsigned seed) {
    Generator generator(seed);
    std::vector<glm::vec3> points(count);
    for (glm::vec3& p : points) p = uniform_point(generator, -1, 1) * glm::vec3(3, 1, 0.2f);
    return points;
}

} // namespace

TEST_CASE("a million rays at each of several objects: none that hits is rejected") {
    std::vector<TriangleSoup> objects{soup_of(bumpy_terrain(20)), ellipsoid({1, 1, 1}, 0),
                                      ellipsoid({30, 1, 0.01f}, 1.1f),
                                      soup_of(random_triangles(200, 0.5f, 1))};
    TriangleSoup far = ellipsoid({1, 2, 3}, 0.4f); // where floats are coarse
    for (glm::vec3& p : far.positions) p += glm::vec3(1000, -2000, 500);
    objects.push_back(far);
    for (uint64_t i = 0; i < objects.size(); ++i) {
        const FittedVolumes volumes = fit_volumes(objects[i].positions);
        for (uint32_t width : {1u, 8u, 16u}) {
            VolumeTester tester = tester_of(volumes, width);
            const uint64_t rays = width == 16 ? 1'000'000 : 100'000;
            const VolumeTrials trials = try_volumes(device(), tester, objects[i], rays, i);
            CHECK(trials.hits > rays / 5);
            for (size_t kind = 0; kind < VOLUME_KINDS.size(); ++kind) {
                INFO("object " << i << ", " << volume_name(VOLUME_KINDS[kind]) << ", width "
                               << width << ", origin " << trials.worst.origin.x << " "
                               << trials.worst.origin.y << " " << trials.worst.origin.z
                               << ", direction " << trials.worst.direction.x << " "
                               << trials.worst.direction.y << " " << trials.worst.direction.z);
                CHECK(trials.wrongly_rejected[kind] == 0);
            }
        }
    }
}

TEST_CASE("the trials notice a volume that is a little too small") {
    const TriangleSoup object = ellipsoid({1, 2, 3}, 0.4f);
    FittedVolumes volumes = fit_volumes(object.positions);
    volumes.box.high[0] -= 0.02f;
    volumes.oriented_box.low[1] += 0.02f;
    volumes.slabs.high[3] -= 0.02f;
    volumes.sphere.radius -= 0.02f;
    VolumeTester tester = tester_of(volumes, 16);
    const VolumeTrials trials = try_volumes(device(), tester, object, 1'000'000, 1);
    for (size_t kind = 0; kind < VOLUME_KINDS.size(); ++kind) {
        INFO(volume_name(VOLUME_KINDS[kind]));
        CHECK(trials.wrongly_rejected[kind] > 0);
    }
}

TEST_CASE("of lines that meet a ball, a convex volume is met by its share of the surface") {
    // Cauchy and Crofton: the measure of lines that meet a convex body is its surface.
    const std::vector<glm::vec3> points = cloud(500, 2);
    const FittedVolumes volumes = fit_volumes(points);
    constexpr size_t COUNT = 400'000;
    const glm::vec3 center(volumes.sphere.center[0], volumes.sphere.center[1],
                           volumes.sphere.center[2]);
    const float radius = 1.5f * volumes.sphere.radius;
    const VolumeRays rays(device(), random_lines(center, radius, COUNT, 3));
    VolumeTester tester = tester_of(volumes, 16);
    for (VolumeKind kind : VOLUME_KINDS) {
        const std::vector<uint32_t> met = tester.met(kind, rays);
        const double share = double(std::ranges::count(met, 1u)) / COUNT;
        const double expected =
            measure_volume(volumes, kind).area / (4 * M_PI * double(radius) * radius);
        INFO(volume_name(kind) << ": " << share << " instead of " << expected);
        CHECK(std::abs(share - expected) < 5 * std::sqrt(expected * (1 - expected) / COUNT) + 1e-5);
    }
}

TEST_CASE("a volume behind the ray is not met, one around its origin is") {
    const FittedVolumes volumes = fit_volumes(ellipsoid({1, 1, 1}, 0).positions);
    const std::vector<VolumeRay> rays{{{0, 0, 3}, {0, 0, 1}},  {{0, 0, 3}, {0, 0, -1}},
                                      {{0, 0, 0}, {1, 2, 3}},  {{0, 0, 0}, {0, 0, -1}},
                                      {{0, 5, 0}, {0, 0, 1}},  {{3, 3, 3}, {-1, -1, -1}},
                                      {{3, 3, 3}, {-1, 1, -1}}};
    for (uint32_t width : {1u, 8u, 16u}) {
        VolumeTester tester = tester_of(volumes, width);
        for (VolumeKind kind : VOLUME_KINDS) {
            INFO(volume_name(kind) << ", width " << width);
            CHECK(tester.met(kind, VolumeRays(device(), rays)) ==
                  std::vector<uint32_t>{0, 1, 1, 1, 0, 1, 0});
        }
    }
}

TEST_CASE("volumes around known shapes have their known sizes") {
    std::vector<glm::vec3> cube;
    for (int i = 0; i < 8; ++i)
        cube.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
    const FittedVolumes upright = fit_volumes(cube);
    for (VolumeKind kind :
         {VolumeKind::box, VolumeKind::oriented_box, VolumeKind::few_slabs, VolumeKind::many_slabs})
        CHECK(measure_volume(upright, kind).volume == Approx(8).epsilon(1e-6));
    CHECK(upright.sphere.radius == Approx(std::sqrt(3.0)).epsilon(1e-6));

    // An octahedron is what the cube's four diagonals cut out.
    const std::vector<glm::vec3> octahedron{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                            {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    CHECK(measure_volume(fit_volumes(octahedron), VolumeKind::few_slabs).volume ==
          Approx(4.0 / 3.0).epsilon(1e-6));
    CHECK(measure_volume(fit_volumes(octahedron), VolumeKind::few_slabs).area ==
          Approx(4 * std::sqrt(3.0)).epsilon(1e-6));
}

TEST_CASE("the oriented box of a turned box is that box") {
    for (float turn : {0.1f, 0.5f, 1.0f, 2.0f}) {
        const glm::mat3 rotation(
            glm::rotate(glm::mat4(1.0f), turn, glm::normalize(glm::vec3(1, 2, -1))));
        std::vector<glm::vec3> points;
        for (int i = 0; i < 8; ++i)
            points.push_back(rotation *
                             (glm::vec3(i & 1 ? 5.f : 0.f, i & 2 ? 3.f : 0.f, i & 4 ? 1.f : 0.f)));
        INFO("turned by " << turn);
        CHECK(measure_volume(fit_oriented_box(points)).volume == Approx(15).epsilon(2e-3));
        CHECK(measure_volume(fit_box(points)).volume > 18);
    }
}

TEST_CASE("the sphere is the smallest one: it rests on points that no smaller one contains") {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const std::vector<glm::vec3> points = cloud(5 + 50 * seed, seed);
        const SphereVolume sphere = fit_sphere(points);
        const glm::dvec3 center(sphere.center[0], sphere.center[1], sphere.center[2]);
        // Toward no side can the centre move without leaving a point behind: the points that it
        // rests on are not all on one side of any plane through it.
        std::vector<glm::dvec3> resting;
        for (glm::vec3 p : points) {
            const glm::dvec3 from = glm::dvec3(p) - center;
            REQUIRE(glm::length(from) <= sphere.radius);
            if (glm::length(from) > sphere.radius * (1 - 1e-5)) resting.push_back(from);
        }
        REQUIRE(resting.size() >= 2);
        Generator generator(seed);
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 side(unit_vector(generator));
            CHECK(std::ranges::any_of(resting, [&](const glm::dvec3& p) {
                return glm::dot(p, side) < 1e-3 * sphere.radius;
            }));
        }
    }
}

TEST_CASE("volumes of a single point, and of points in a line or plane, are met by rays to it") {
    for (const std::vector<glm::vec3>& points :
         {std::vector<glm::vec3>{{1, 2, 3}}, std::vector<glm::vec3>{{1, 2, 3}, {1, 2, 3}},
          std::vector<glm::vec3>{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}},
          std::vector<glm::vec3>{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}}) {
        VolumeTester tester = tester_of(fit_volumes(points), 16);
        std::vector<VolumeRay> rays;
        for (glm::vec3 p : points)
            for (glm::vec3 from : {glm::vec3(5, 6, 7), glm::vec3(-3, 2, 3), glm::vec3(1, 2, -9)})
                rays.push_back({from, p - from});
        for (VolumeKind kind : VOLUME_KINDS) {
            INFO(points.size() << " points, " << volume_name(kind));
            CHECK(tester.met(kind, VolumeRays(device(), rays)) ==
                  std::vector<uint32_t>(rays.size(), 1));
        }
    }
}
