// How work is cut for a device: the one place where device facts become render settings.
#pragma once

#include "core/enum_words.h"
#include "gpu/device.h"

#include <cstdint>
#include <string>

namespace onde::gpu {

enum class QueueKind {
    chunk_local, ///< each work item owns a range of paths and compacts it in place
    global,      ///< one queue per stage, appended to with aggregated atomics
};

constexpr auto enum_words(QueueKind) {
    return std::array{EnumWord{QueueKind::chunk_local, "chunk-local"},
                      EnumWord{QueueKind::global, "global"}};
}

enum class Launch {
    staged, ///< one kernel per stage and bounce
    fused,  ///< one kernel in which a work item runs all stages and bounces of its chunk
};

constexpr auto enum_words(Launch) {
    return std::array{EnumWord{Launch::staged, "staged"}, EnumWord{Launch::fused, "fused"}};
}

struct DeviceSettings {
    uint32_t width = 1;            ///< paths that one work item shades at once (lanes)
    uint32_t wave_size = 1u << 20; ///< paths in flight
    uint32_t chunk = 1;            ///< paths of one work item; a multiple of `width`
    uint32_t local_size = 64;      ///< work items of a group; fewer where a kernel takes no more
    QueueKind queue = QueueKind::global;
    Launch launch = Launch::staged;
    bool primary_packets = false; ///< trace primary rays in packets of 16
    /// Rays of late bounces take turns in a tree of more bytes, which waits for memory otherwise.
    uint64_t interleave_above = UINT64_MAX;

    bool operator==(const DeviceSettings&) const = default;
};

/// The settings that measured best for devices of this kind (CPUs), or that follow from their
/// architecture (GPUs; not yet measured).
DeviceSettings default_settings(const DeviceFacts& facts);

/// One line for the log, for example "16 lanes, waves of 65536 paths, ...".
std::string describe(const DeviceSettings& settings);

} // namespace onde::gpu
