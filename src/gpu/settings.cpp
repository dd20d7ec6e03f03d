#include "gpu/settings.h"

#include <fmt/format.h>

namespace onde::gpu {

DeviceSettings default_settings(const DeviceFacts& facts) {
    if (!facts.is_cpu) return {};
    return {.width = facts.avx512 ? 16u : 8u,
            .wave_size = 1u << 16,
            .chunk = 256,
            .local_size = 1,
            .queue = QueueKind::chunk_local,
            .launch = Launch::fused,
            .primary_packets = true,
            .interleave_above = facts.cache};
}

std::string describe(const DeviceSettings& settings) {
    return fmt::format("{} lane{}, waves of {} paths, {} per work item, groups of {}, {} queues, "
                       "{} stages, primary packets {}",
                       settings.width, settings.width == 1 ? "" : "s", settings.wave_size,
                       settings.chunk, settings.local_size,
                       settings.queue == QueueKind::chunk_local ? "chunk-local" : "global",
                       settings.launch == Launch::fused ? "fused" : "separate",
                       settings.primary_packets ? "on" : "off");
}

} // namespace onde::gpu
