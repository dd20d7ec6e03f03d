// Who else can say what rays hit: brute force in double precision, and Embree.
#pragma once

#include "doctor/brute_force.h"
#include "kernels/traversal_rig.h"

#include <embree3/rtcore.h>

namespace onde::test::traversal {

using doctor::traversal::BruteForce;

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
