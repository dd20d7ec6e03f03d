// A tree's buffers on the device, in any layout.
#pragma once

#include "accel/bvh.h"
#include "gpu/buffer.h"
#include "gpu/program.h"

namespace onde {

/// The kernel text of a layout, which comes before all text that traverses.
std::string layout_file(BvhLayout layout);

/// Uses the tree's memory in place where the device is a CPU: the tree must outlive it. Move-only.
class DeviceBvh {
  public:
    DeviceBvh(const gpu::Device& device, const Bvh& bvh);

    /// Binds the members of BvhView (kernels/trace/bvh_view.h) from argument `first` on; returns
    /// the next index.
    uint32_t bind(gpu::Kernel& kernel, uint32_t first) const;

    /// What a traversal may read of nodes and leaves.
    uint64_t bytes() const { return nodes_.size() + blocks_.size(); }

  private:
#define ONDE_BUFFER(Type, name, words) gpu::Buffer<Type> name##_;
    BVH_BUFFERS(ONDE_BUFFER)
#undef ONDE_BUFFER
    uint32_t root_;
};

} // namespace onde
