// Who else can say what rays hit: brute force in double precision, and Embree.
#pragma once

#include "kernels/traversal_rig.h"

#include <embree3/rtcore.h>

namespace onde::test::traversal {

/// Every primitive of every placement, one after the other, in double precision. `margin` widens
/// triangles (in barycentric coordinates) and spheres (relative), to tell close calls.
class BruteForce {
  public:
    BruteForce(const World& world, double margin) : world_(world), margin_(margin) {}

    Hit closest(const Ray& ray) const {
        best_ = ray.t_max;
        Hit hit = {ray.t_max, 0, 0, BVH_NONE, BVH_NONE};
        for (uint32_t i = 0; i < world_.placements.size(); ++i) {
            const Placement& placement = world_.placements[i];
            const glm::dmat4 inverse = glm::inverse(glm::dmat4(placement.object_to_world));
            const glm::dvec3 origin(inverse * glm::dvec4(ray.origin, 1.0));
            const glm::dvec3 direction(inverse * glm::dvec4(ray.direction, 0.0));
            const bool direct = world_.bvh.instances[i].root == BVH_NONE;
            visit(world_.geometries[placement.geometry], origin, direction, ray.t_min,
                  direct ? BVH_NONE : i, hit);
        }
        return hit;
    }

  private:
    void visit(const Geometry& geometry, glm::dvec3 origin, glm::dvec3 direction, double t_min,
               uint32_t instance, Hit& hit) const {
        for (uint32_t i = 0; i < geometry.triangles.size(); ++i)
            visit_triangle(geometry, i, origin, direction, t_min, instance, hit);
        for (uint32_t i = 0; i < geometry.spheres.size(); ++i)
            visit_sphere(geometry.spheres[i], origin, direction, t_min,
                         geometry.first_primitive + uint32_t(geometry.triangles.size()) + i,
                         instance, hit);
    }

    void visit_triangle(const Geometry& geometry, uint32_t index, glm::dvec3 origin,
                        glm::dvec3 direction, double t_min, uint32_t instance, Hit& hit) const {
        const glm::uvec3 corners = geometry.triangles[index];
        const glm::dvec3 v0(geometry.positions[corners.x]);
        const glm::dvec3 e1 = glm::dvec3(geometry.positions[corners.y]) - v0;
        const glm::dvec3 e2 = glm::dvec3(geometry.positions[corners.z]) - v0;
        const glm::dvec3 p = glm::cross(direction, e2);
        const double determinant = glm::dot(e1, p);
        if (determinant == 0) return;
        const glm::dvec3 s = origin - v0, q = glm::cross(s, e1);
        const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
        const double t = glm::dot(e2, q) / determinant;
        if (u < -margin_ || v < -margin_ || u + v > 1 + margin_ || t <= t_min || t >= best_) return;
        best_ = t;
        hit = {float(t), float(u), float(v), geometry.first_primitive + index, instance};
    }

    void visit_sphere(const SphereInput& sphere, glm::dvec3 origin, glm::dvec3 direction,
                      double t_min, uint32_t id, uint32_t instance, Hit& hit) const {
        const glm::dvec3 f = origin - glm::dvec3(sphere.center);
        const double radius = sphere.radius * (1 + margin_);
        const double a = glm::dot(direction, direction), b = glm::dot(f, direction);
        const double discriminant = b * b - a * (glm::dot(f, f) - radius * radius);
        if (discriminant < 0) return;
        const double root = std::sqrt(discriminant);
        for (double t : {(-b - root) / a, (-b + root) / a}) {
            if (t <= t_min || t >= best_) continue;
            best_ = t;
            hit = {float(t), 0, 0, id, instance};
            return;
        }
    }

    const World& world_;
    double margin_;
    mutable double best_ = 0;
};

/// Requires the kernel's answer on every ray that is not a close call.
inline void check_against_brute_force(const World& world, const std::vector<Ray>& rays,
                                      Abilities abilities = Abilities::needed) {
    Tracer tracer(world, {}, abilities);
    const std::vector<Hit> hits = tracer.closest(rays);
    const std::vector<uint32_t> blocked = tracer.occluded(rays);
    const BruteForce exact(world, 0), wide(world, 1e-4), narrow(world, -1e-4);
    size_t close_calls = 0, misses = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const Hit expected = exact.closest(rays[i]);
        if (!same_primitive(wide.closest(rays[i]), narrow.closest(rays[i]))) {
            ++close_calls;
            continue;
        }
        misses += !is_hit(expected);
        INFO("ray " << i << ": t " << hits[i].t << ", expected " << expected.t);
        REQUIRE(same_primitive(hits[i], expected));
        REQUIRE(same_distance(hits[i].t, expected.t));
        REQUIRE(std::abs(hits[i].u - expected.u) < 1e-2f);
        REQUIRE(std::abs(hits[i].v - expected.v) < 1e-2f);
        REQUIRE(blocked[i] == uint32_t(is_hit(expected)));
    }
    CHECK(close_calls < rays.size() / 50);
    CHECK(misses > 0);
    CHECK(misses < rays.size());
}

/// Embree's closest hits of the world's first geometry.
inline std::vector<float> embree_distances(const Soup& soup, const std::vector<Ray>& rays) {
    RTCDevice embree = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(embree);
    RTCGeometry geometry = rtcNewGeometry(embree, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto copy = [&](RTCBufferType type, RTCFormat format, const auto& values) {
        void* memory =
            rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(values[0]), values.size());
        std::memcpy(memory, values.data(), values.size() * sizeof(values[0]));
    };
    copy(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, soup.positions);
    copy(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, soup.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);

    std::vector<float> distances;
    for (const Ray& ray : rays) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query{};
        query.ray = {ray.origin.x,
                     ray.origin.y,
                     ray.origin.z,
                     ray.t_min,
                     ray.direction.x,
                     ray.direction.y,
                     ray.direction.z,
                     0.0f,
                     ray.t_max,
                     ~0u,
                     0,
                     0};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &query);
        distances.push_back(query.ray.tfar);
    }
    rtcReleaseScene(scene);
    rtcReleaseDevice(embree);
    return distances;
}

inline void check_against_embree(Soup soup, const std::vector<Ray>& rays) {
    const World world(std::move(soup));
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    const std::vector<float> expected = embree_distances(world.soups[0], rays);
    size_t different = 0, found = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        different += !same_distance(hits[i].t, expected[i]);
        found += is_hit(hits[i]);
    }
    CHECK(found > rays.size() / 10);
    CHECK(different <= 20 * rays.size() / 1'000'000 + 1);
}

} // namespace onde::test::traversal
