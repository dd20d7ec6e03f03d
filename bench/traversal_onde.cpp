#include "traversal_onde.h"

namespace onde::bench {

namespace {

constexpr size_t LOCAL_SIZE = 64, MANY = 1u << 20;

gpu::ProgramRequest request(const Bvh& tree) {
    std::vector<gpu::KernelShape> kernels{{"closest", LOCAL_SIZE, MANY},
                                          {"occluded", LOCAL_SIZE, MANY}};
    if (tree.layout == BvhLayout::wide)
        for (const char* name : {"closest_packet", "closest_stream", "occluded_stream"})
            kernels.push_back({name, 4, MANY});
    return {"bench/traversal.cl",
            {fmt::format("ONDE_STACK_SIZE={}", tree.stack_size), "ONDE_INSTANCES=0",
             "ONDE_SPHERES=0", fmt::format("ONDE_WATERTIGHT={:d}", tree.watertight),
             fmt::format("ONDE_BVH_LAYOUT={}", uint32_t(tree.layout))},
            std::move(kernels)};
}

Bvh build(const Geometry& geometry, const BvhOptions& options) {
    const Placement placement;
    Bvh bvh = build_bvh({&geometry, 1}, {&placement, 1}, options);
    narrow_bvh(bvh, options.layout);
    return bvh;
}

} // namespace

OndeTracer::OndeTracer(const gpu::Device& device, const gpu::KernelSources& sources,
                       const Geometry& geometry, const BvhOptions& options)
    : device_(device), bvh_(build(geometry, options)), tree_(device, bvh_),
      program_(gpu::build_program(device, sources, request(bvh_), nullptr)) {}

OndeTracers::OndeTracers(const gpu::Device& device, const gpu::KernelSources& sources,
                         const Geometry& geometry, BvhBuilder builder)
    : wide(device, sources, geometry, {.builder = builder}),
      watertight(device, sources, geometry, {.builder = builder, .watertight = true}),
      compressed(device, sources, geometry, {.builder = builder, .layout = BvhLayout::compressed}),
      binary(device, sources, geometry, {.builder = builder, .layout = BvhLayout::binary}) {}

template <class Result>
void OndeTracer::launch(const char* name, size_t items, const DeviceRays& set,
                        const gpu::Buffer<Result>& results) {
    gpu::Kernel& kernel = program_.kernel(name);
    kernel.set_from(0, uint32_t(set.rays.size()));
    kernel.set_from(tree_.bind(kernel, 1), set.rays, results);
    kernel.launch(items);
    device_.finish();
}

void OndeTracer::closest(const DeviceRays& set) {
    launch("closest", set.rays.size(), set, set.hits);
}
void OndeTracer::closest_packet(const DeviceRays& set) {
    launch("closest_packet", (set.rays.size() + 15) / 16, set, set.hits);
}
void OndeTracer::occluded(const DeviceRays& set) {
    launch("occluded", set.rays.size(), set, set.blocked);
}
void OndeTracer::closest_stream(const DeviceRays& set) {
    launch("closest_stream", (set.rays.size() + 15) / 16, set, set.hits);
}
void OndeTracer::occluded_stream(const DeviceRays& set) {
    launch("occluded_stream", (set.rays.size() + 15) / 16, set, set.blocked);
}

} // namespace onde::bench
