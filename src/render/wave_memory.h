// The memory of a wavefront's paths in flight; its layout is kernels/wavefront/wave.h.
#pragma once

#include "gpu/buffer_list.h"
#include "gpu/program.h"
#include "render/estimator.h"
#include "render/options.h"

#include <CL/cl_platform.h>

namespace onde {

class WaveMemory {
  public:
    /// For settings.wave_size paths of the estimator, with what options say of their film.
    /// Staged launches have a second copy of the state, and a queue.
    WaveMemory(gpu::BufferList& list, const EstimatorShape& estimator,
               const RenderOptions& options);

    /// Binds WAVE_PARAMETERS from `first` on; returns the next index.
    uint32_t bind(gpu::Kernel& kernel, uint32_t first) const;
    /// Binds what staged kernels have besides, from `first` on.
    void bind_queue(gpu::Kernel& kernel, uint32_t first) const;
    /// Sets the two copies of the state, which steps take by turns, in a kernel whose
    /// WAVE_PARAMETERS begin at `first` and whose queue parameters at `queue`.
    void set_states(gpu::Kernel& kernel, uint32_t first, uint32_t queue, uint32_t step) const;

    /// How many paths are alive, for steps of either parity.
    const gpu::Buffer<uint32_t>& queue() const { return queue_; }

  private:
    uint32_t stride_;
    gpu::Buffer<float> state_, work_;
    gpu::Buffer<cl_float4> sums_;
    gpu::Buffer<float> next_state_;
    gpu::Buffer<uint32_t> queue_;
};

} // namespace onde
