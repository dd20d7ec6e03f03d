// How work is cut for a device: the one place where device facts become render settings.
#pragma once

#include "core/enum_words.h"
#include "gpu/device.h"

#include <cstdint>
#include <string>

namespace onde::gpu {

enum class Launch {
    staged, ///< one kernel per stage and bounce, over a queue that all work items share
    fused, ///< one kernel: a work item runs all stages and bounces of its chunk, compacted in place
};

constexpr auto enum_words(Launch) {
    return std::array{EnumWord{Launch::staged, "staged"}, EnumWord{Launch::fused, "fused"}};
}

struct DeviceSettings {
    uint32_t width = 1;            ///< paths that one work item shades at once (lanes)
    uint32_t wave_size = 1u << 20; ///< paths in flight
    uint32_t chunk = 1;            ///< paths of one work item; a multiple of `width`
    uint32_t local_size = 64;      ///< work items of a group; fewer where a kernel takes no more
    Launch launch = Launch::staged;
    /// Rays of late bounces are interleaved in a BVH of more bytes, which waits for memory
    /// otherwise.
    uint64_t interleave_above = UINT64_MAX;

    bool operator==(const DeviceSettings&) const = default;
};

/// The settings that measured best for devices of this kind (CPUs), or that follow from their
/// architecture (GPUs; not yet measured).
DeviceSettings default_settings(const DeviceFacts& facts);

/// One line for the log, for example "16 lanes, waves of 65536 paths, ...".
std::string describe(const DeviceSettings& settings);

} // namespace onde::gpu
