// Onde as a contender: its tree and its kernels on an OpenCL device.
#pragma once

#include "gpu/program.h"
#include "traversal_rays.h"
#include "upload/device_tree.h"

namespace onde::bench {

/// A ray set in device memory, and room for its answers.
struct DeviceRays {
    gpu::Buffer<Ray> rays;
    gpu::Buffer<Hit> hits;
    gpu::Buffer<uint32_t> blocked;

    DeviceRays(const gpu::Device& device, std::span<const Ray> set)
        : rays(device, set), hits(device, set.size()), blocked(device, set.size()) {}
};

/// One tree and its kernels.
class OndeTracer {
  public:
    OndeTracer(const gpu::Device& device, const gpu::KernelSources& sources,
               const Geometry& geometry, const BvhOptions& options);

    /// Each launches one kernel over the set and waits for it. Packets and streams walk the wide
    /// layout only.
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
    Bvh bvh_;
    DeviceTree tree_;
    gpu::Program program_;
};

/// The trees that take part, from one builder.
struct OndeTracers {
    OndeTracer wide, watertight, compressed, binary;

    OndeTracers(const gpu::Device& device, const gpu::KernelSources& sources,
                const Geometry& geometry, BvhBuilder builder);
};

} // namespace onde::bench
