#include "render/wave_memory.h"

#include "shared/aovs.h"
#include "shared/columns.h"

#include <bit>

namespace onde {
namespace {

/// Groups at the end may be stored whole, and columns a power of two apart would share cache sets.
constexpr uint32_t COLUMN_PADDING = 272;

// As kernels/wavefront/wave.h counts them, from the same lists.
uint32_t moved_columns(const EstimatorShape& estimator) {
    return estimator.state_columns + 1; // and its index in the wave
}
uint32_t work_columns(const EstimatorShape& estimator) {
    return 1 + COLUMN_COUNT(HIT_COLUMNS) + estimator.connection_columns;
}

/// Radiance of every path, then the AOVs that are more than functions of it and groups of lights,
/// as columns.
size_t sum_count(const RenderOptions& options, size_t stride) {
    const uint32_t stored = options.aovs & ~SAMPLE_AOVS;
    const size_t columns = size_t(std::popcount(stored)) + options.light_groups.size();
    return options.settings.wave_size + columns * stride;
}

} // namespace

WaveMemory::WaveMemory(gpu::BufferList& list, const EstimatorShape& estimator,
                       const RenderOptions& options)
    : stride_(options.settings.wave_size + COLUMN_PADDING),
      state_(list.add<float>("path states", size_t(stride_) * moved_columns(estimator))),
      work_(list.add<float>("hits and connections", size_t(stride_) * work_columns(estimator))),
      sums_(list.add<cl_float4>("path sums", sum_count(options, stride_))) {
    if (options.settings.launch != gpu::Launch::staged) return;
    next_state_ = list.add<float>("next path states", size_t(stride_) * moved_columns(estimator));
    queue_ = list.add<uint32_t>("queue lengths", 2);
}

uint32_t WaveMemory::bind(gpu::Kernel& kernel, uint32_t first) const {
    return kernel.set_from(first, state_, work_, sums_, stride_);
}

void WaveMemory::bind_queue(gpu::Kernel& kernel, uint32_t first) const {
    kernel.set_from(first, next_state_, queue_);
}

void WaveMemory::set_states(gpu::Kernel& kernel, uint32_t first, uint32_t queue,
                            uint32_t step) const {
    kernel.set(first, step % 2 ? next_state_ : state_);
    kernel.set(queue, step % 2 ? state_ : next_state_);
}

} // namespace onde
