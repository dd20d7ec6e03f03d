#include "render/wave_memory.h"

namespace onde {
namespace {

constexpr uint32_t STATE_LANES = 17, SHADOW_LANES = 10; // as in kernels/wavefront/state.h

/// Lanes a power of two apart would fall into the same cache sets.
constexpr uint32_t LANE_PADDING = 272;

uint32_t stride(const gpu::DeviceSettings& settings) {
    return settings.wave_size + LANE_PADDING;
}

// How many elements the buffers have.
size_t state_count(const gpu::DeviceSettings& settings) {
    return size_t(stride(settings)) * STATE_LANES;
}
size_t next_state_count(const gpu::DeviceSettings& settings) {
    return settings.queue == gpu::QueueKind::global ? state_count(settings) : 1;
}
size_t shadow_count(const gpu::DeviceSettings& settings) {
    return size_t(stride(settings)) * SHADOW_LANES;
}
size_t live_count(const gpu::DeviceSettings& settings) {
    return settings.wave_size / settings.chunk + 1;
}

} // namespace

WaveMemory::WaveMemory(const gpu::Device& device, const gpu::DeviceSettings& settings)
    : bytes_(total_bytes(plan(settings))), stride_(stride(settings)),
      state_(device, state_count(settings)), next_state_(device, next_state_count(settings)),
      shadow_(device, shadow_count(settings)), radiance_(device, settings.wave_size),
      live_(device, live_count(settings)) {}

std::vector<BufferSize> WaveMemory::plan(const gpu::DeviceSettings& settings) {
    return {{"path states", state_count(settings) * sizeof(float)},
            {"next path states", next_state_count(settings) * sizeof(float)},
            {"shadow rays", shadow_count(settings) * sizeof(float)},
            {"path radiance", settings.wave_size * sizeof(cl_float4)},
            {"live counts", live_count(settings) * sizeof(uint32_t)}};
}

void WaveMemory::bind(gpu::Kernel& kernel, uint32_t first, uint32_t bounce, bool swapped) const {
    kernel.set_from(first, swapped ? next_state_ : state_, swapped ? state_ : next_state_, shadow_,
                    radiance_, stride_, live_, bounce);
}

} // namespace onde
