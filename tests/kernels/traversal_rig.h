// Worlds of triangles, spheres and instances, and the kernels that walk their trees.
#pragma once

#include "accel/soups.h"
#include "support/programs.h"
#include "upload/ray_query.h"
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cstring>

namespace onde::test::traversal {

using namespace onde::gpu;

using Ray = QueryRay;
using Hit = QueryHit;

inline bool operator==(const Hit& a, const Hit& b) {
    return std::memcmp(&a, &b, sizeof(Hit)) == 0;
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
          program_(programs().build(request(world.bvh, std::move(defines), abilities))) {}

    std::vector<Hit> closest(std::span<const Ray> rays) {
        return trace<Hit>("closest", rays, rays.size());
    }
    std::vector<Hit> closest_stream(std::span<const Ray> rays) {
        return trace<Hit>("closest_stream", rays, (rays.size() + 15) / 16);
    }
    std::vector<Hit> closest_interleaved(std::span<const Ray> rays) {
        return trace<Hit>("closest_interleaved", rays, (rays.size() + 15) / 16);
    }
    /// What each of the traversals finds: single rays, streams, interleaved rays.
    std::array<std::vector<Hit>, 3> closest_by_all(std::span<const Ray> rays) {
        return {closest(rays), closest_stream(rays), closest_interleaved(rays)};
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
        const bool wide = bvh.layout == BvhLayout::wide;
        const uint32_t group = device().facts().tracing_group();
        defines.push_back(fmt::format("ONDE_STREAM_QUERIES={:d}", wide));
        std::vector<KernelShape> kernels{{"closest", group}, {"occluded", group}};
        if (wide)
            for (const char* name : {"closest_stream", "closest_interleaved", "occluded_stream"})
                kernels.push_back({name, 1});
        return {
            "trace/query.cl", std::move(defines), std::move(kernels), {layout_file(bvh.layout)}};
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

    DeviceBvh tree_;
    Program program_;
};

inline bool same_primitive(const Hit& a, const Hit& b) {
    return a.primitive == b.primitive && a.instance == b.instance;
}
inline bool is_hit(const Hit& hit) {
    return hit.primitive != BVH_NONE;
}

inline bool same_distance(float a, float b, float tolerance = 1e-4f) {
    return std::abs(a - b) <= tolerance * std::max(1.0f, std::abs(b));
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

} // namespace onde::test::traversal
