#include "render/wave_memory.h"

namespace onde {
namespace {

constexpr uint32_t STATE_LANES = 17, SHADOW_LANES = 10; // as in kernels/wavefront/state.h

/// Lanes a power of two apart would fall into the same cache sets.
constexpr uint32_t LANE_PADDING = 272;

} // namespace

WaveMemory::WaveMemory(gpu::BufferList& buffers, const gpu::DeviceSettings& settings)
    : stride_(settings.wave_size + LANE_PADDING),
      state_(buffers.add<float>("path states", size_t(stride_) * STATE_LANES)),
      next_state_(buffers.add<float>("next path states", settings.queue == gpu::QueueKind::global
                                                             ? size_t(stride_) * STATE_LANES
                                                             : 1)),
      shadow_(buffers.add<float>("shadow rays", size_t(stride_) * SHADOW_LANES)),
      radiance_(buffers.add<cl_float4>("path radiance", settings.wave_size)),
      live_(buffers.add<uint32_t>("live counts", settings.wave_size / settings.chunk + 1)) {}

void WaveMemory::bind(gpu::Kernel& kernel, uint32_t first, uint32_t bounce, bool swapped) const {
    kernel.set_from(first, swapped ? next_state_ : state_, swapped ? state_ : next_state_, shadow_,
                    radiance_, stride_, live_, bounce);
}

} // namespace onde
