// Onde as a contender: its tree and its kernels on an OpenCL device.
#pragma once

#include "gpu/program.h"
#include "traversal_rays.h"

namespace onde::bench {

/// A ray set in device memory, and room for its answers.
struct DeviceRays {
    gpu::Buffer<Ray> rays;
    gpu::Buffer<Hit> hits;
    gpu::Buffer<uint32_t> blocked;

    DeviceRays(const gpu::Device& device, std::span<const Ray> set)
        : rays(device, set), hits(device, set.size()), blocked(device, set.size()) {}
};

class OndeTracer {
  public:
    /// `tree` must outlive the tracer.
    OndeTracer(const gpu::Device& device, const gpu::KernelSources& sources, const Bvh& tree);

    /// Each launches one kernel over the set and waits for it.
    void closest(const DeviceRays& set);
    void closest_packet(const DeviceRays& set);
    void occluded(const DeviceRays& set);
    void closest_stream(const DeviceRays& set);
    void occluded_stream(const DeviceRays& set);

  private:
    template <class Result>
    void launch(const char* kernel, size_t items, const DeviceRays& set,
                const gpu::Buffer<Result>& results);

    const gpu::Device& device_;
    gpu::Buffer<BvhNode> nodes_;
    gpu::Buffer<TriangleBlock> blocks_;
    gpu::Buffer<BvhSphere> spheres_;
    gpu::Buffer<BvhInstance> instances_;
    uint32_t root_;
    gpu::Program program_;
};

} // namespace onde::bench
