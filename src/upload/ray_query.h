// Rays through one tree and nothing else: what measures layouts, here and in the traversal bench.
#pragma once

#include "gpu/program.h"
#include "upload/device_bvh.h"

#include <span>
#include <string>
#include <vector>

namespace onde {

/// A ray that hits at t_min < t <= t_max.
struct QueryRay {
    glm::vec3 origin{0.0f};
    float t_min = 0.0f;
    glm::vec3 direction{0.0f}; ///< of any length
    float t_max = 1e30f;
};
static_assert(sizeof(QueryRay) == 32);

/// A closest hit as the kernels write it; primitive BVH_NONE where there is none.
struct QueryHit {
    float t, u, v;
    uint32_t primitive, instance;
};
static_assert(sizeof(QueryHit) == 20);

/// Rays in device memory, and room for their answers.
struct QueryRays {
    gpu::Buffer<QueryRay> rays;
    gpu::Buffer<QueryHit> hits;
    gpu::Buffer<uint32_t> blocked;

    QueryRays(const gpu::Device& device, std::span<const QueryRay> set)
        : rays(device, set), hits(device, set.size()), blocked(device, set.size()) {}
};

/// The kernels that a query compiles: of single rays, or of ray streams and interleaved rays too,
/// which the wide layout alone has.
enum class QueryKernels { single, every };

/// The BVH of one geometry of triangles, and its kernels. The programs must outlive it.
class RayQuery {
  public:
    RayQuery(gpu::Programs& programs, const Geometry& geometry, const BvhOptions& options,
             QueryKernels kernels = QueryKernels::single, std::vector<std::string> defines = {});

    /// Each launches one kernel over the set and waits for it.
    void closest(const QueryRays& set) { launch("closest", 1, set, set.hits); }
    void occluded(const QueryRays& set) { launch("occluded", 1, set, set.blocked); }
    void closest_stream(const QueryRays& set) { launch("closest_stream", 16, set, set.hits); }
    void closest_interleaved(const QueryRays& set) {
        launch("closest_interleaved", 16, set, set.hits);
    }
    void occluded_stream(const QueryRays& set) { launch("occluded_stream", 32, set, set.blocked); }

  private:
    template <class Result>
    void launch(const char* kernel, size_t rays_per_item, const QueryRays& set,
                const gpu::Buffer<Result>& results);

    const gpu::Device& device_;
    Bvh bvh_;
    DeviceBvh tree_;
    gpu::Program program_;
};

} // namespace onde
