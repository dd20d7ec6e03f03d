// What the kernels' walks answer: against brute force in double precision, against Embree, and
// against each other, bit by bit.
#include "accel/soups.h"
#include "gpu/program.h"
#include "scene/load.h"
#include "support/assets.h"

#include <catch2/catch.hpp>
#include <embree3/rtcore.h>

#include <bit>
#include <cstring>

using namespace onde;
using namespace onde::gpu;
using namespace onde::test;

namespace {

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
bool operator==(const Hit& a, const Hit& b) {
    return std::memcmp(&a, &b, sizeof(Hit)) == 0;
}

const Device& device() {
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

/// The bench's kernels over one tree.
class Tracer {
  public:
    explicit Tracer(const World& world, std::vector<std::string> defines = {})
        : nodes_(Buffer<BvhNode>::in_place(device(), world.bvh.nodes)),
          blocks_(Buffer<TriangleBlock>::in_place(device(), world.bvh.blocks)),
          spheres_(Buffer<BvhSphere>::in_place(device(), world.bvh.spheres)),
          instances_(Buffer<BvhInstance>::in_place(device(), world.bvh.instances)),
          root_(world.bvh.root),
          program_(build_program(device(), KernelSources::embedded(),
                                 request(world.bvh, std::move(defines)), nullptr)) {}

    std::vector<Hit> closest(std::span<const Ray> rays) {
        return trace<Hit>("closest", rays, rays.size());
    }
    std::vector<Hit> closest_packet(std::span<const Ray> rays) {
        return trace<Hit>("closest_packet", rays, (rays.size() + 15) / 16);
    }
    std::vector<uint32_t> occluded(std::span<const Ray> rays) {
        return trace<uint32_t>("occluded", rays, rays.size());
    }

  private:
    static ProgramRequest request(const Bvh& bvh, std::vector<std::string> defines) {
        defines.push_back(fmt::format("ONDE_STACK_SIZE={}", bvh.stack_size));
        defines.push_back(fmt::format("ONDE_INSTANCES={:d}", bvh.has_instances));
        defines.push_back(fmt::format("ONDE_SPHERES={:d}", !bvh.spheres.empty()));
        return {"bench/traversal.cl",
                std::move(defines),
                {{"closest", 64}, {"closest_packet", 1}, {"occluded", 64}}};
    }

    template <class Result>
    std::vector<Result> trace(const char* name, std::span<const Ray> rays, size_t items) {
        const Buffer<Ray> input(device(), rays);
        const Buffer<Result> output(device(), rays.size());
        Kernel& kernel = program_.kernel(name);
        kernel.set_from(0, uint32_t(rays.size()), nodes_, blocks_, spheres_, instances_, root_,
                        input, output);
        kernel.launch(items);
        return output.read(device());
    }

    Buffer<BvhNode> nodes_;
    Buffer<TriangleBlock> blocks_;
    Buffer<BvhSphere> spheres_;
    Buffer<BvhInstance> instances_;
    uint32_t root_;
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

std::vector<Ray> random_rays(size_t count, unsigned seed, float spread = 2.0f) {
    Generator generator(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = uniform_point(generator, -spread, spread);
        ray.direction = uniform_point(generator, -1.0f, 1.0f) - 0.4f * ray.origin;
    }
    return rays;
}

/// A pinhole's rays through a square of pixels, tile by tile, so that packets are coherent.
std::vector<Ray> pinhole_rays(uint32_t side, glm::vec3 eye, glm::vec3 target, float spread) {
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

std::vector<Ray> join(std::vector<Ray> a, const std::vector<Ray>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

bool same_primitive(const Hit& a, const Hit& b) {
    return a.primitive == b.primitive && a.instance == b.instance;
}
bool is_hit(const Hit& hit) {
    return hit.primitive != BVH_NONE;
}

bool same_distance(float a, float b, float tolerance = 1e-4f) {
    return std::abs(a - b) <= tolerance * std::max(1.0f, std::abs(b));
}

/// Requires the kernel's answer on every ray that is not a close call.
void check_against_brute_force(const World& world, const std::vector<Ray>& rays) {
    Tracer tracer(world);
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

World grove() {
    Generator generator(17);
    std::vector<Placement> placements = {{0, glm::mat4(1.0f)}};
    for (uint32_t i = 0; i < 20; ++i)
        placements.push_back({1 + i % 2, random_transform(generator, 2.0f)});
    Soup mixed = random_triangles(60, 0.6f, 31);
    mixed.spheres = random_spheres(10, 0.3f, 32).spheres;
    return World({random_triangles(100, 0.4f, 30), std::move(mixed), random_triangles(3, 1.0f, 33)},
                 std::move(placements));
}

/// The number of places at which two lists of results differ in any bit.
template <class T>
size_t differences(const std::vector<T>& a, const std::vector<T>& b) {
    REQUIRE(a.size() == b.size());
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += !(a[i] == b[i]);
    return count;
}

/// Embree's closest hits of the world's first geometry.
std::vector<float> embree_distances(const Soup& soup, const std::vector<Ray>& rays) {
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

void check_against_embree(Soup soup, const std::vector<Ray>& rays) {
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

std::vector<Ray> varied_rays() {
    return join(pinhole_rays(256, {1.2f, 0.9f, 1.5f}, {0, 0, 0}, 1.2f), random_rays(60000, 41));
}

} // namespace

TEST_CASE("closest and any hits on triangles are those of brute force") {
    check_against_brute_force(World(random_triangles(400, 0.3f, 1)), random_rays(20000, 2));
}

TEST_CASE("closest and any hits on spheres are those of brute force") {
    check_against_brute_force(World(random_spheres(200, 0.2f, 3)), random_rays(20000, 4));
}

TEST_CASE("closest and any hits on instances are those of brute force") {
    check_against_brute_force(grove(), random_rays(10000, 5, 4.0f));
}

TEST_CASE("a tree that is a single leaf answers like brute force") {
    check_against_brute_force(World(random_triangles(5, 1.0f, 6)), random_rays(5000, 7));
    check_against_brute_force(World(random_spheres(1, 1.0f, 8)), random_rays(5000, 9));
}

TEST_CASE("a million rays at a bumpy terrain hit what Embree says") {
    check_against_embree(
        bumpy_terrain(200),
        join(pinhole_rays(700, {1.2f, 0.9f, 1.5f}, {0, 0, 0}, 1.2f), random_rays(510000, 10)));
}

TEST_CASE("a million rays at a scanned bunny hit what Embree says") {
    const auto path = find_asset("obj/stanford-bunny.obj");
    if (!path) return;
    const Scene scene = load_scene(*path);
    Soup soup;
    soup.positions = scene.meshes.at(0).positions;
    soup.triangles = scene.meshes.at(0).triangles;
    const SceneBounds bounds = scene_bounds(scene);
    for (glm::vec3& position : soup.positions)
        position = (position - 0.5f * (bounds.low + bounds.high)) /
                   glm::length(bounds.high - bounds.low) * 2.0f;
    check_against_embree(std::move(soup), join(pinhole_rays(700, {0, 0.4f, 2}, {0, 0, 0}, 1.0f),
                                               random_rays(510000, 11, 1.0f)));
}

TEST_CASE("packets answer like single rays, bit for bit") {
    const std::vector<Ray> rays = varied_rays();
    Soup mixed = random_triangles(2000, 0.1f, 12);
    mixed.spheres = random_spheres(300, 0.1f, 13).spheres;
    for (const World& world : {World(bumpy_terrain(150)), World(std::move(mixed)), grove(),
                               World(random_triangles(6, 1.0f, 14))}) {
        Tracer tracer(world);
        CHECK(differences(tracer.closest(rays), tracer.closest_packet(rays)) == 0);
    }
}

TEST_CASE("a packet that is not full answers for its rays alone") {
    const World world(bumpy_terrain(20));
    Tracer tracer(world);
    const std::vector<Ray> rays = random_rays(37, 15, 1.0f);
    CHECK(differences(tracer.closest(rays), tracer.closest_packet(rays)) == 0);
}

TEST_CASE("the portable code answers like that with machine instructions, bit for bit") {
    const std::vector<Ray> rays = varied_rays();
    for (const World& world : {World(bumpy_terrain(150)), grove()}) {
        Tracer fast(world);
        Tracer portable(world, {"ONDE_AVX512=0", "ONDE_AVX2=0"});
        CHECK(differences(fast.closest(rays), portable.closest(rays)) == 0);
        CHECK(differences(fast.closest_packet(rays), portable.closest_packet(rays)) == 0);
        CHECK(differences(fast.occluded(rays), portable.occluded(rays)) == 0);
    }
}

TEST_CASE("hits do not depend on the tree's shape") {
    const std::vector<Ray> rays = varied_rays();
    World world(random_triangles(5000, 0.1f, 16));
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    world.bvh = build_bvh(world.geometries, world.placements, {.bins = 4, .traversal_cost = 8.0f});
    const std::vector<Hit> others = Tracer(world).closest(rays);
    size_t different = 0;
    for (size_t i = 0; i < rays.size(); ++i)
        different += hits[i].primitive != others[i].primitive ||
                     !same_distance(hits[i].t, others[i].t, 1e-6f);
    CHECK(different == 0);
}

TEST_CASE("of triangles in one place the one with the smallest id is hit") {
    Soup soup;
    for (int i = 0; i < 100; ++i) soup.add({-1, -1, 0}, {2, -1, 0}, {-1, 2, 0});
    const World world(std::move(soup));
    Tracer tracer(world);
    std::vector<Ray> rays;
    Generator generator(18);
    for (int i = 0; i < 1000; ++i) {
        const float x = uniform(generator, -0.8f, 0.4f), y = uniform(generator, -0.8f, 0.4f);
        rays.push_back({{x, y, 3}, 0.0f, {0.01f, 0.02f, -1}, 1e30f});
    }
    for (const std::vector<Hit>& hits : {tracer.closest(rays), tracer.closest_packet(rays)})
        CHECK(std::ranges::all_of(hits, [](const Hit& hit) { return hit.primitive == 0; }));
}

TEST_CASE("axis-parallel rays in the planes of boxes find the triangles there") {
    // A grid of squares in z = 0 whose edges, and so whose boxes, lie at multiples of 1/8.
    Soup soup;
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; ++column) {
            const glm::vec3 corner(0.125f * float(column), 0.125f * float(row), 0.0f);
            const glm::vec3 x(0.125f, 0, 0), y(0, 0.125f, 0);
            soup.add(corner, corner + x, corner + y);
            soup.add(corner + x + y, corner + y, corner + x);
        }
    const World world(std::move(soup));
    std::vector<Ray> rays;
    for (int row = 1; row < 32; ++row)
        for (int column = 1; column < 32; ++column)
            for (float z : {1.0f, -1.0f})
                for (float zero : {0.0f, -0.0f})
                    rays.push_back({{0.0625f * float(column), 0.0625f * float(row), z},
                                    0.0f,
                                    {zero, zero, -z},
                                    1e30f});
    Tracer tracer(world);
    const std::vector<uint32_t> blocked = tracer.occluded(rays);
    for (const std::vector<Hit>& hits : {tracer.closest(rays), tracer.closest_packet(rays)})
        for (size_t i = 0; i < rays.size(); ++i) {
            INFO("ray " << i);
            REQUIRE(is_hit(hits[i]));
            REQUIRE(hits[i].t == 1.0f);
            REQUIRE(blocked[i] == 1);
        }
}

TEST_CASE("rays along z that start on a box plane find the next triangle") {
    Soup soup;
    for (int i = 0; i < 64; ++i) {
        const float z = float(i);
        soup.add({0, 0, z}, {1, 0, z}, {0, 1, z});
    }
    const World world(std::move(soup));
    std::vector<Ray> rays;
    for (int i = 0; i < 64; ++i) rays.push_back({{0.25f, 0.25f, float(i)}, 0.0f, {0, 0, 1}, 1e30f});
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    for (uint32_t i = 0; i < 63; ++i) {
        CHECK(hits[i].primitive == i + 1);
        CHECK(hits[i].t == 1.0f);
    }
    CHECK(hits[63].primitive == BVH_NONE);
    CHECK(hits[63].t == 1e30f);
}

TEST_CASE("a hit lies in the half-open interval from t_min to t_max") {
    Soup soup;
    soup.add({0, 0, 2}, {1, 0, 2}, {0, 1, 2});
    const World world(std::move(soup));
    Tracer tracer(world);
    const auto hits = [&](float t_min, float t_max) {
        const std::vector<Ray> rays = {{{0.25f, 0.25f, 0}, t_min, {0, 0, 1}, t_max}};
        const bool closest = is_hit(tracer.closest(rays)[0]);
        CHECK(closest == is_hit(tracer.closest_packet(rays)[0]));
        CHECK(closest == bool(tracer.occluded(rays)[0]));
        return closest;
    };
    CHECK(hits(0.0f, 3.0f));
    CHECK(hits(0.0f, 2.0f));
    CHECK_FALSE(hits(0.0f, 1.9999f));
    CHECK(hits(1.9999f, 3.0f));
    CHECK_FALSE(hits(2.0f, 3.0f));
    CHECK(hits(0.0f, INFINITY));
}

TEST_CASE("rays with NaN or infinity, and rays into an empty world, hit nothing") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = INFINITY;
    std::vector<Ray> rays;
    for (float bad : {nan, infinity, -infinity})
        for (int place = 0; place < 6; ++place) {
            Ray ray = {{0, 0, 3}, 0.0f, {0, 0, -1}, 1e30f};
            (place < 3 ? ray.origin : ray.direction)[glm::length_t(place % 3)] = bad;
            rays.push_back(ray);
        }
    Soup mixed = random_triangles(500, 0.5f, 19);
    mixed.spheres = {{glm::vec3(0.0f), 1.0f}};
    for (const World& world : {World(std::move(mixed)), World(Soup{}), grove()}) {
        Tracer tracer(world);
        const std::vector<Ray> asked =
            world.geometries[0].triangles.empty() ? random_rays(100, 20) : rays;
        for (const std::vector<Hit>& hits : {tracer.closest(asked), tracer.closest_packet(asked)})
            CHECK(std::ranges::none_of(hits, is_hit));
        for (uint32_t blocked : tracer.occluded(asked)) CHECK(blocked == 0);
    }
}

TEST_CASE("rays from twenty world extents away still find the ground") {
    constexpr float FAR = 8.0f;
    const World world(bumpy_terrain(50));
    Generator generator(21);
    std::vector<Ray> rays;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 target(uniform(generator, -0.9f, 0.9f), 0, uniform(generator, -0.9f, 0.9f));
        const glm::vec3 origin = target + FAR * glm::vec3(0.3f, 5.0f, -0.2f);
        rays.push_back({origin, 0.0f, target - origin, 1e30f});
    }
    const std::vector<Hit> hits = Tracer(world).closest(rays);
    CHECK(std::ranges::count_if(hits, is_hit) >= 1999);
}
