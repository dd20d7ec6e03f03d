#include "upload/ray_query.h"

#include <algorithm>

namespace onde {

namespace {

gpu::ProgramRequest request(const Bvh& bvh, QueryKernels kernels, uint32_t group,
                            std::vector<std::string> defines) {
    constexpr size_t MANY = 1u << 20;
    defines.push_back(fmt::format("ONDE_STACK_SIZE={}", bvh.stack_size));
    defines.push_back("ONDE_INSTANCES=0");
    defines.push_back("ONDE_SPHERES=0");
    defines.push_back(fmt::format("ONDE_WATERTIGHT={:d}", bvh.watertight));
    defines.push_back(fmt::format("ONDE_STREAM_QUERIES={:d}", kernels == QueryKernels::every));
    gpu::ProgramRequest request{"trace/query.cl",
                                std::move(defines),
                                {{"closest", group, MANY}, {"occluded", group, MANY}},
                                {layout_file(bvh.layout)}};
    if (kernels == QueryKernels::every)
        for (const char* name : {"closest_stream", "closest_interleaved", "occluded_stream"})
            request.kernels.push_back({name, std::min(group, 4u), MANY});
    return request;
}

Bvh build(const Geometry& geometry, const BvhOptions& options) {
    const Placement placement;
    Bvh bvh = build_bvh({&geometry, 1}, {&placement, 1}, options);
    compact_bvh(bvh, options.layout);
    return bvh;
}

} // namespace

RayQuery::RayQuery(gpu::Programs& programs, const Geometry& geometry, const BvhOptions& options,
                   QueryKernels kernels, std::vector<std::string> defines)
    : device_(programs.device()), bvh_(build(geometry, options)), tree_(device_, bvh_),
      program_(programs.build(
          request(bvh_, kernels, device_.facts().tracing_group(), std::move(defines)))) {}

template <class Result>
void RayQuery::launch(const char* name, size_t rays_per_item, const QueryRays& set,
                      const gpu::Buffer<Result>& results) {
    gpu::Kernel& kernel = program_.kernel(name);
    kernel.set_from(0, uint32_t(set.rays.size()));
    kernel.set_from(tree_.bind(kernel, 1), set.rays, results);
    kernel.launch((set.rays.size() + rays_per_item - 1) / rays_per_item);
    device_.finish();
}

template void RayQuery::launch(const char*, size_t, const QueryRays&, const gpu::Buffer<QueryHit>&);
template void RayQuery::launch(const char*, size_t, const QueryRays&, const gpu::Buffer<uint32_t>&);

} // namespace onde
