// Rays, worlds and the walks that answer them: on the device, by brute force in double precision,
// and by Embree.
#pragma once

#include "accel/soups.h"
#include "gpu/program.h"
#include "scene/load.h"
#include "support/assets.h"
#include "support/test_cache.h"
#include "upload/device_tree.h"
#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <embree3/rtcore.h>

namespace onde::test::traversal {

using namespace onde::gpu;

struct Ray {
    glm::vec3 origin;
    float t_min = 0.0f;
    glm::vec3 direction;
    float t_max = 1e30f;
};
static_assert(sizeof(Ray) == 32);

struct Hit {
    float t, u, v;
    uint32_t primitive, instance;
};
inline bool operator==(const Hit& a, const Hit& b) {
    return std::memcmp(&a, &b, sizeof(Hit)) == 0;
}

inline const Device& device() {
    static const Device opened = open_device();
    return opened;
}

/// Geometries, their placements and their tree.
struct World {
    std::vector<Soup> soups;
    std::vector<Geometry> geometries;
    std::vector<Placement> placements;
    Bvh bvh;

    World(std::vector<Soup> parts, std::vector<Placement> placed)
        : soups(std::move(parts)), placements(std::move(placed)) {
        uint32_t first = 0;
        for (Soup& soup : soups) {
            soup.first_primitive = first;
            first += soup.size();
            geometries.push_back(soup.geometry());
        }
        bvh = build_bvh(geometries, placements);
        REQUIRE(validate_bvh(bvh, geometries, placements) == "");
    }
    explicit World(Soup soup) : World({std::move(soup)}, {{0, glm::mat4(1.0f)}}) {}
};

/// Kernels that do what a tree needs, or everything, so that more trees share a program.
enum class Abilities { needed, all };

/// The bench's kernels over one tree.
class Tracer {
  public:
    explicit Tracer(const World& world, std::vector<std::string> defines = {},
                    Abilities abilities = Abilities::needed)
        : tree_(device(), world.bvh),
          program_(build_program(device(), KernelSources::embedded(),
                                 request(world.bvh, std::move(defines), abilities),
                                 &test_cache())) {}

    std::vector<Hit> closest(std::span<const Ray> rays) {
        return trace<Hit>("closest", rays, rays.size());
    }
    std::vector<Hit> closest_packet(std::span<const Ray> rays) {
        return trace<Hit>("closest_packet", rays, (rays.size() + 15) / 16);
    }
    std::vector<Hit> closest_stream(std::span<const Ray> rays) {
        return trace<Hit>("closest_stream", rays, (rays.size() + 15) / 16);
    }
    std::vector<uint32_t> occluded(std::span<const Ray> rays) {
        return trace<uint32_t>("occluded", rays, rays.size());
    }
    std::vector<uint32_t> occluded_stream(std::span<const Ray> rays) {
        return trace<uint32_t>("occluded_stream", rays, (rays.size() + 31) / 32);
    }

  private:
    static ProgramRequest request(const Bvh& bvh, std::vector<std::string> defines,
                                  Abilities abilities) {
        const bool all = abilities == Abilities::all;
        // Of few sizes, so that trees share programs.
        const uint32_t stack = std::bit_ceil(std::max(bvh.stack_size, all ? 256u : 64u));
        defines.push_back(fmt::format("ONDE_STACK_SIZE={}", stack));
        defines.push_back(fmt::format("ONDE_INSTANCES={:d}", all || bvh.has_instances));
        defines.push_back(fmt::format("ONDE_SPHERES={:d}", all || !bvh.spheres.empty()));
        defines.push_back(fmt::format("ONDE_BVH_LAYOUT={}", uint32_t(bvh.layout)));
        std::vector<KernelShape> kernels{{"closest", 64}, {"occluded", 64}};
        if (bvh.layout == BvhLayout::wide)
            for (const char* name : {"closest_packet", "closest_stream", "occluded_stream"})
                kernels.push_back({name, 1});
        return {"bench/traversal.cl", std::move(defines), std::move(kernels)};
    }

    template <class Result>
    std::vector<Result> trace(const char* name, std::span<const Ray> rays, size_t items) {
        const Buffer<Ray> input(device(), rays);
        const Buffer<Result> output(device(), rays.size());
        Kernel& kernel = program_.kernel(name);
        kernel.set_from(0, uint32_t(rays.size()));
        kernel.set_from(tree_.bind(kernel, 1), input, output);
        kernel.launch(items);
        return output.read(device());
    }

    DeviceTree tree_;
    Program program_;
};

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

inline std::vector<Ray> random_rays(size_t count, unsigned seed, float spread = 2.0f) {
    Generator generator(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = uniform_point(generator, -spread, spread);
        ray.direction = uniform_point(generator, -1.0f, 1.0f) - 0.4f * ray.origin;
    }
    return rays;
}

/// A pinhole's rays through a square of pixels, tile by tile, so that packets are coherent.
inline std::vector<Ray> pinhole_rays(uint32_t side, glm::vec3 eye, glm::vec3 target, float spread) {
    const glm::vec3 forward = glm::normalize(target - eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0.1f, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    std::vector<Ray> rays;
    for (uint32_t i = 0; i < side * side; ++i) {
        const uint32_t tile = i / 16, column = 4 * (tile % (side / 4)) + i % 4;
        const uint32_t row = 4 * (tile / (side / 4)) + i / 4 % 4;
        const float x = (float(column) + 0.5f) / float(side) - 0.5f;
        const float y = (float(row) + 0.5f) / float(side) - 0.5f;
        rays.push_back({eye, 0.0f, forward + spread * (x * right + y * up), 1e30f});
    }
    return rays;
}

inline std::vector<Ray> join(std::vector<Ray> a, const std::vector<Ray>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

inline bool same_primitive(const Hit& a, const Hit& b) {
    return a.primitive == b.primitive && a.instance == b.instance;
}
inline bool is_hit(const Hit& hit) {
    return hit.primitive != BVH_NONE;
}

inline bool same_distance(float a, float b, float tolerance = 1e-4f) {
    return std::abs(a - b) <= tolerance * std::max(1.0f, std::abs(b));
}

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

inline World grove() {
    Generator generator(17);
    std::vector<Placement> placements = {{0, glm::mat4(1.0f)}};
    for (uint32_t i = 0; i < 20; ++i)
        placements.push_back({1 + i % 2, random_transform(generator, 2.0f)});
    Soup mixed = random_triangles(60, 0.6f, 31);
    mixed.spheres = random_spheres(10, 0.3f, 32).spheres;
    return World({random_triangles(100, 0.4f, 30), std::move(mixed), random_triangles(3, 1.0f, 33)},
                 std::move(placements));
}

/// Triangles and spheres in one tree.
inline World mixed_world() {
    Soup soup = random_triangles(1500, 0.3f, 41);
    soup.spheres = random_spheres(100, 0.1f, 42).spheres;
    return World(std::move(soup));
}

/// Long thin triangles, crosswise, some far larger than the rest and far from the origin: spatial
/// splits cut most of them many times. And flat ones, in the planes of their boxes.
inline World needles() {
    Soup soup;
    Generator generator(43);
    for (int i = 0; i < 1500; ++i) {
        const float length = i % 10 == 0 ? 30.0f : 2.0f;
        const glm::vec3 middle = uniform_point(generator), d = length * uniform_point(generator);
        soup.add(middle - d, middle + d, middle + d + 0.05f * uniform_point(generator));
    }
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 corner = uniform_point(generator);
        soup.add(corner, corner + glm::vec3(0.2f, 0, 0), corner + glm::vec3(0, 0, 0.2f));
    }
    return World(std::move(soup));
}

/// The number of hits that are not the same primitive at the same distance, give or take rounding.
inline size_t unlike(const std::vector<Hit>& hits, const std::vector<Hit>& expected) {
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i)
        count += !same_primitive(hits[i], expected[i]) ||
                 !same_distance(hits[i].t, expected[i].t, 1e-6f);
    return count;
}

/// The number of places at which two lists of results differ in any bit.
template <class T>
inline size_t differences(const std::vector<T>& a, const std::vector<T>& b) {
    REQUIRE(a.size() == b.size());
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += !(a[i] == b[i]);
    return count;
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

/// Those through side x side pixels, and nearly as many at random.
inline std::vector<Ray> varied_rays(uint32_t side = 256) {
    return join(pinhole_rays(side, {1.2f, 0.9f, 1.5f}, {0, 0, 0}, 1.2f),
                random_rays(side * side * 9 / 10, 41));
}

} // namespace onde::test::traversal
