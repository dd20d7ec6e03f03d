// Analytic shapes on the device against a double-precision solver that knows no quartic: it walks
// each ray in small steps over the distance to the surface.
#include "kernels/traversal_rig.h"

#include <cmath>

using namespace onde;
using namespace onde::test;
using namespace onde::test::traversal;

namespace {

constexpr double NOTHING = INFINITY;

/// The distance from p to the canonical shape's surface, negative inside; at most so large.
double signed_distance(const ShapeInput& shape, const glm::dvec3& p) {
    const double rho = std::hypot(p.x, p.z);
    switch (shape.kind) {
    case SHAPE_TORUS:
        return std::hypot(rho - 1, p.y) - double(shape.minor_radius);
    case SHAPE_CYLINDER:
        return std::max(rho - 1, std::abs(p.y) - 1);
    case SHAPE_CONE:
        return std::max((rho + p.y - 1) * std::sqrt(0.5), -p.y);
    default:
        return glm::length(p) - 1;
    }
}

/// Where the ray enters (or leaves) the shape: distances bound how far a step may go, and the last
/// one is halved until doubles end. `fatter`: distance by which the surface is moved outward. Rays
/// start clear of the surface.
double march(const ShapeInput& shape, const glm::dvec3& origin, const glm::dvec3& direction,
             double fatter = 0) {
    const double length = glm::length(direction);
    const glm::dvec3 d = direction / length;
    const auto at = [&](double t) { return signed_distance(shape, origin + t * d) - fatter; };
    const double side = at(0) < 0 ? -1 : 1;
    double far = glm::length(origin) + 2.5;
    double t = std::max(0.0, glm::length(origin) - 2.5);
    double last = 0;
    while (t < far) {
        const double clear = side * at(t);
        if (clear < 0) { // a step of at least the least size crossed the surface
            double inside = t;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (last + inside);
                (side * at(middle) < 0 ? inside : last) = middle;
            }
            return inside / length;
        }
        last = t;
        t += std::max(clear, 2e-6);
    }
    return NOTHING;
}

/// Whether a surface that lies `width` further in or out is met somewhere else altogether.
bool grazes(const ShapeInput& shape, const glm::dvec3& origin, const glm::dvec3& direction,
            double width) {
    const double fat = march(shape, origin, direction, width);
    const double thin = march(shape, origin, direction, -width);
    return fat != thin && !(std::abs(fat - thin) * glm::length(direction) < 100 * width);
}

World one_shape(const ShapeInput& shape, const glm::mat4& placement) {
    Soup soup;
    soup.shapes = {shape};
    return World({std::move(soup)}, {{0, placement}});
}

/// Rays from around and from inside, a third of them aimed at the rim of the shape.
std::vector<Ray> rays_at(size_t count, unsigned seed) {
    Generator generator(seed);
    std::vector<Ray> rays(count);
    for (size_t i = 0; i < count; ++i) {
        const float reach = i % 7 == 0 ? 0.9f : i % 7 == 1 ? 60.0f : 4.0f;
        rays[i].origin = reach * uniform_point(generator);
        const float angle = uniform(generator, 0.0f, 6.2831853f);
        const float rim = i % 3 == 0 ? 1.3f : 1.0f;
        const glm::vec3 target = glm::vec3(rim * std::cos(angle), 0, rim * std::sin(angle)) +
                                 0.4f * uniform_point(generator);
        rays[i].direction = uniform(generator, 0.2f, 3.0f) * (target - rays[i].origin);
    }
    return rays;
}

struct Verdict {
    size_t hits = 0, misses = 0, close_calls = 0, wrong = 0;
    double worst = 0; ///< distance from the hit to the surface, in object space
};

/// Compares in object space, where the shape has size 1.
Verdict judge(const ShapeInput& shape, const std::vector<Ray>& rays, double silhouette) {
    const World world = one_shape(shape, glm::mat4(1.0f));
    Tracer tracer(world);
    const std::vector<traversal::Hit> hits = tracer.closest(rays);
    const std::vector<uint32_t> blocked = tracer.occluded(rays);
    Verdict verdict;
    for (size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 origin(rays[i].origin), direction(rays[i].direction);
        if (std::abs(signed_distance(shape, origin)) < 1e-3) continue;
        const double expected = march(shape, origin, direction);
        const bool hit = is_hit(hits[i]);
        if (bool(blocked[i]) != hit) ++verdict.wrong;
        if (!hit && expected == NOTHING) {
            ++verdict.misses;
            continue;
        }
        if (hit) {
            const glm::dvec3 p = origin + double(hits[i].t) * direction;
            // Floats that are as large as the origin can not say more.
            const double digits = 1e-6 * std::max(1.0, glm::length(origin));
            verdict.worst = std::max(verdict.worst, std::abs(signed_distance(shape, p)) / digits);
        }
        if (hit && expected != NOTHING) {
            const double error = std::abs(hits[i].t - expected) * glm::length(direction);
            ++verdict.hits;
            if (error < 1e-4 * std::max(1.0, glm::length(origin))) continue;
        }
        // They differ: right only within a hair of the silhouette.
        if (grazes(shape, origin, direction, silhouette)) {
            ++verdict.close_calls;
            continue;
        }
        UNSCOPED_INFO("ray " << i << ": t " << hits[i].t << ", expected " << expected);
        ++verdict.wrong;
    }
    return verdict;
}

} // namespace

TEST_CASE("a torus is hit from afar at its outermost circle, where its ball touches it") {
    Generator generator(11);
    const ShapeInput torus{SHAPE_TORUS, 0.3125f};
    const World world = one_shape(torus, glm::mat4(1.0f));
    std::vector<Ray> rays(20000);
    for (Ray& ray : rays) {
        const float angle = uniform(generator, 0.0f, 6.2831853f);
        const glm::vec3 outward(std::cos(angle), 0, std::sin(angle));
        const glm::vec3 target =
            1.3125f * outward + glm::vec3(0, uniform(generator, -1e-4f, 1e-4f), 0);
        ray.origin = target + uniform(generator, 3.0f, 12.0f) *
                                  glm::normalize(outward + 0.7f * uniform_point(generator));
        ray.direction = target - ray.origin;
    }
    const std::vector<traversal::Hit> hits = Tracer(world).closest(rays);
    size_t wrong = 0;
    for (size_t i = 0; i < rays.size(); ++i) wrong += !(std::abs(hits[i].t - 1) < 1e-5f);
    CHECK(wrong == 0);
}

TEST_CASE("a torus is hit where double precision says, thick, thin or almost closed") {
    for (const float minor_radius : {0.25f, 0.02f, 0.6f, 0.9f}) {
        const Verdict v = judge({SHAPE_TORUS, minor_radius}, rays_at(40000, 5), 1e-4);
        INFO("minor radius " << minor_radius << ": " << v.hits << " hits, " << v.misses
                             << " misses, " << v.close_calls << " close calls");
        CHECK(v.wrong == 0);
        CHECK(v.worst < 10.0);
        CHECK(v.hits > 500);
        CHECK((v.misses > 500 || minor_radius > 0.5f));
        CHECK(v.close_calls < 40);
    }
}

TEST_CASE("a torus is hit where double precision says, by ten million rays") {
    Verdict sum;
    for (unsigned seed = 100; seed < 125; ++seed) {
        const Verdict v = judge({SHAPE_TORUS, 0.25f}, rays_at(400000, seed), 1e-4);
        sum.hits += v.hits, sum.misses += v.misses;
        sum.close_calls += v.close_calls, sum.wrong += v.wrong;
        sum.worst = std::max(sum.worst, v.worst);
    }
    WARN(sum.hits << " hits, " << sum.misses << " misses, " << sum.close_calls << " close calls, "
                  << sum.wrong << " wrong, at worst " << sum.worst << "e-6 off the surface");
    CHECK(sum.wrong == 0);
}

TEST_CASE("ellipsoids, cylinders and cones are hit where double precision says") {
    for (const uint32_t kind : {SHAPE_ELLIPSOID, SHAPE_CYLINDER, SHAPE_CONE}) {
        const Verdict v = judge({kind, 0.25f}, rays_at(40000, 6), 1e-4);
        INFO("kind " << kind << ": " << v.hits << " hits, " << v.misses << " misses, "
                     << v.close_calls << " close calls");
        CHECK(v.wrong == 0);
        CHECK(v.worst < 10.0);
        CHECK(v.hits > 500);
        CHECK(v.misses > 500);
        CHECK(v.close_calls < 40);
    }
}

TEST_CASE("a disk is hit inside its rim only, from both sides, and never along its plane") {
    const World world = one_shape({SHAPE_DISK, 0.25f}, glm::mat4(1.0f));
    Tracer tracer(world);
    Generator generator(3);
    std::vector<Ray> rays = {{{-3, 0, 0}, 0, {1, 0, 0}, 1e30f}};
    for (int i = 0; i < 20000; ++i)
        rays.push_back({3.0f * uniform_point(generator), 0, uniform_point(generator), 1e30f});
    const std::vector<traversal::Hit> hits = tracer.closest(rays);
    CHECK_FALSE(is_hit(hits[0]));
    size_t found = 0;
    for (size_t i = 1; i < rays.size(); ++i) {
        const double t = -double(rays[i].origin.y) / double(rays[i].direction.y);
        const glm::dvec3 p = glm::dvec3(rays[i].origin) + t * glm::dvec3(rays[i].direction);
        const double rho = std::hypot(p.x, p.z);
        if (std::abs(rho - 1) < 1e-4 || std::abs(t) < 1e-4) continue;
        const bool expected = t > 0 && rho < 1;
        REQUIRE(is_hit(hits[i]) == expected);
        if (!expected) continue;
        ++found;
        REQUIRE(same_distance(hits[i].t, float(t)));
    }
    CHECK(found > 300);
}

TEST_CASE("rays that leave a shape's surface do not meet it again where it is convex") {
    // From points offset as shading offsets them, outward: an ellipsoid, a cylinder and a cone are
    // never met; a torus only across its hole.
    Generator generator(9);
    for (const uint32_t kind : {SHAPE_ELLIPSOID, SHAPE_CYLINDER, SHAPE_CONE, SHAPE_TORUS}) {
        const ShapeInput shape = {kind, 0.25f};
        const World world = one_shape(shape, glm::mat4(1.0f));
        Tracer tracer(world);
        const std::vector<Ray> there = rays_at(20000, 11);
        const std::vector<traversal::Hit> hits = tracer.closest(there);
        std::vector<Ray> away;
        for (size_t i = 0; i < there.size(); ++i) {
            const glm::dvec3 o(there[i].origin);
            if (!is_hit(hits[i]) || signed_distance(shape, o) < 0 || glm::length(o) > 10) continue;
            glm::dvec3 p = o + double(hits[i].t) * glm::dvec3(there[i].direction);
            glm::dvec3 n;
            for (glm::length_t k = 0; k < 3; ++k) {
                glm::dvec3 step(0);
                step[k] = 1e-6;
                n[k] = signed_distance(shape, p + step) - signed_distance(shape, p - step);
            }
            n = glm::normalize(n);
            p += (2e-5 - signed_distance(shape, p)) * n;
            glm::dvec3 d(uniform_point(generator));
            if (glm::dot(d, n) < 0) d = -d;
            if (glm::dot(d, n) < 0.02 * glm::length(d)) continue;
            if (kind == SHAPE_TORUS && march(shape, p, d) != NOTHING) continue;
            away.push_back({glm::vec3(p), 0.0f, glm::vec3(d), 1e30f});
        }
        const std::vector<uint32_t> blocked = tracer.occluded(away);
        INFO("kind " << kind << ", " << away.size() << " rays");
        CHECK(away.size() > 2000);
        CHECK(std::count(blocked.begin(), blocked.end(), 1u) == 0);
    }
}
