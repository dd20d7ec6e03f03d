// The memory of a wavefront's paths in flight; its layout is kernels/wavefront/state.h.
#pragma once

#include "gpu/buffer_list.h"
#include "gpu/program.h"
#include "render/options.h"

#include <CL/cl_platform.h>

namespace onde {

class WaveMemory {
  public:
    /// For settings.wave_size paths; a second copy of the state for global queues.
    WaveMemory(gpu::BufferList& buffers, const gpu::DeviceSettings& settings);

    /// Binds STATE_PARAMETERS of kernels/wavefront/queue.h from `first` on. `swapped` exchanges the
    /// two copies of the state.
    void bind(gpu::Kernel& kernel, uint32_t first, uint32_t bounce, bool swapped) const;

  private:
    uint32_t stride_;
    gpu::Buffer<float> state_, next_state_, shadow_;
    gpu::Buffer<cl_float4> radiance_;
    gpu::Buffer<uint32_t> live_;
};

} // namespace onde
