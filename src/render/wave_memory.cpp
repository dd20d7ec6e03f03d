#include "render/wave_memory.h"

namespace onde {
namespace {

constexpr uint32_t STATE_LANES = 17, SHADOW_LANES = 10; // as in kernels/wavefront/state.h

/// Lanes a power of two apart would fall into the same cache sets.
constexpr uint32_t LANE_PADDING = 272;

} // namespace

WaveMemory::WaveMemory(const gpu::Device& device, const gpu::DeviceSettings& settings)
    : stride_(settings.wave_size + LANE_PADDING), state_(device, size_t(stride_) * STATE_LANES),
      next_state_(device,
                  settings.queue == gpu::QueueKind::global ? size_t(stride_) * STATE_LANES : 1),
      shadow_(device, size_t(stride_) * SHADOW_LANES), radiance_(device, settings.wave_size),
      live_(device, settings.wave_size / settings.chunk + 1) {}

void WaveMemory::bind(gpu::Kernel& kernel, uint32_t first, uint32_t bounce, bool swapped) const {
    kernel.set_from(first, swapped ? next_state_ : state_, swapped ? state_ : next_state_, shadow_,
                    radiance_, stride_, live_, bounce);
}

uint64_t WaveMemory::bytes() const {
    return (state_.size() + next_state_.size() + shadow_.size()) * sizeof(float) +
           radiance_.size() * sizeof(cl_float4) + live_.size() * sizeof(uint32_t);
}

} // namespace onde
