// Worlds of triangles, spheres and instances, the kernels that traverse their trees, and who else
// can say what rays hit: brute force in double precision.
#pragma once

#include "doctor/soups.h"
#include "upload/ray_query.h"

#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace onde::doctor::traversal {

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

    World(std::vector<Soup> parts, std::vector<Placement> placed, const BvhOptions& options = {})
        : soups(std::move(parts)), placements(std::move(placed)) {
        uint32_t first = 0;
        for (Soup& soup : soups) {
            soup.first_primitive = first;
            first += soup.size();
            geometries.push_back(soup.geometry());
        }
        bvh = build_bvh(geometries, placements, options);
        const std::string wrong = validate_bvh(bvh, geometries, placements);
        if (!wrong.empty()) throw std::runtime_error("the tree is wrong: " + wrong);
    }
    explicit World(Soup soup) : World({std::move(soup)}, {{0, glm::mat4(1.0f)}}) {}
};

/// Kernels that do what a tree needs, or everything, so that more trees share a program.
enum class Abilities { needed, all };

/// The kernels of ray queries over one tree, which the programs and the world outlive.
class Tracer {
  public:
    Tracer(gpu::Programs& programs, const World& world, std::vector<std::string> defines = {},
           Abilities abilities = Abilities::needed)
        : device_(programs.device()), tree_(device_, world.bvh),
          program_(programs.build(request(device_, world.bvh, std::move(defines), abilities))) {}

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
    static gpu::ProgramRequest request(const gpu::Device& device, const Bvh& bvh,
                                       std::vector<std::string> defines, Abilities abilities) {
        const bool all = abilities == Abilities::all;
        // Of few sizes, so that trees share programs.
        const uint32_t stack = std::bit_ceil(std::max(bvh.stack_size, all ? 256u : 64u));
        defines.push_back(fmt::format("ONDE_STACK_SIZE={}", stack));
        defines.push_back(fmt::format("ONDE_INSTANCES={:d}", all || bvh.has_instances));
        defines.push_back(fmt::format("ONDE_SPHERES={:d}", all || !bvh.spheres.empty()));
        const bool wide = bvh.layout == BvhLayout::wide;
        const uint32_t group = device.facts().tracing_group();
        defines.push_back(fmt::format("ONDE_STREAM_QUERIES={:d}", wide));
        std::vector<gpu::KernelShape> kernels{{"closest", group}, {"occluded", group}};
        if (wide)
            for (const char* name : {"closest_stream", "closest_interleaved", "occluded_stream"})
                kernels.push_back({name, 1});
        return {
            "trace/query.cl", std::move(defines), std::move(kernels), {layout_file(bvh.layout)}};
    }

    template <class Result>
    std::vector<Result> trace(const char* name, std::span<const Ray> rays, size_t items) {
        const gpu::Buffer<Ray> input(device_, rays);
        const gpu::Buffer<Result> output(device_, rays.size());
        gpu::Kernel& kernel = program_.kernel(name);
        kernel.set_from(0, uint32_t(rays.size()));
        kernel.set_from(tree_.bind(kernel, 1), input, output);
        kernel.launch(items);
        return output.read(device_);
    }

    const gpu::Device& device_;
    DeviceBvh tree_;
    gpu::Program program_;
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

} // namespace onde::doctor::traversal
