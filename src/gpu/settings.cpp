#include "gpu/settings.h"

#include <fmt/format.h>

#include <algorithm>

namespace onde::gpu {

namespace {

uint32_t cpu_width(const DeviceFacts& facts) {
    if (!facts.keeps_vectors()) return 1;
    return facts.avx512 ? 16 : 8;
}

} // namespace

DeviceSettings default_settings(const DeviceFacts& facts) {
    if (!facts.is_cpu)
        return {.local_size = uint32_t(std::min<size_t>(64, facts.max_work_group_size))};
    const uint32_t width = cpu_width(facts);
    return {.width = width,
            .wave_size = 1u << 16,
            .chunk = 256,
            .local_size = 1,
            .launch = Launch::fused,
            .interleave_above = facts.cache};
}

std::string describe(const DeviceSettings& settings) {
    return fmt::format("{} lane{}, waves of {} paths, {} per work item, groups of {}, {} stages",
                       settings.width, settings.width == 1 ? "" : "s", settings.wave_size,
                       settings.chunk, settings.local_size, word_of(settings.launch));
}

} // namespace onde::gpu
