#include "traversal_onde.h"

namespace onde::bench {

namespace {

constexpr size_t LOCAL_SIZE = 64, MANY = 1u << 20;

gpu::ProgramRequest request(const Bvh& tree) {
    return {"bench/traversal.cl",
            {fmt::format("ONDE_STACK_SIZE={}", tree.stack_size), "ONDE_INSTANCES=0",
             "ONDE_SPHERES=0", fmt::format("ONDE_WATERTIGHT={:d}", tree.watertight)},
            {{"closest", LOCAL_SIZE, MANY},
             {"closest_packet", 4, MANY},
             {"occluded", LOCAL_SIZE, MANY},
             {"closest_stream", 4, MANY},
             {"occluded_stream", 4, MANY}}};
}

} // namespace

OndeTracer::OndeTracer(const gpu::Device& device, const gpu::KernelSources& sources,
                       const Bvh& tree)
    : device_(device), nodes_(gpu::Buffer<BvhNode>::in_place(device, tree.nodes)),
      blocks_(gpu::Buffer<TriangleBlock>::in_place(device, tree.blocks)),
      spheres_(device, tree.spheres), instances_(device, tree.instances), root_(tree.root),
      program_(gpu::build_program(device, sources, request(tree), nullptr)) {}

template <class Result>
void OndeTracer::launch(const char* name, size_t items, const DeviceRays& set,
                        const gpu::Buffer<Result>& results) {
    gpu::Kernel& kernel = program_.kernel(name);
    kernel.set_from(0, uint32_t(set.rays.size()), nodes_, blocks_, spheres_, instances_, root_,
                    set.rays, results);
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
