// What a render takes on the device, known before anything is allocated.
#pragma once

#include "render/options.h"
#include "upload/pack.h"

#include <vector>

namespace onde {

/// The buffers of a render, in three groups. Small ones (frame, counters) are left out.
struct MemoryPlan {
    std::vector<BufferSize> scene, paths, film;

    uint64_t bytes() const { return total_bytes(scene) + total_bytes(paths) + total_bytes(film); }
};

/// The plan of a render with these options. The scene's part is packed.device_buffers(); it stays
/// empty for the caller to fill in.
MemoryPlan plan_memory(const RenderOptions& options);

/// Throws DeviceError, with what is needed and what there is, when a buffer is larger than the
/// device allows or all of them are larger than its memory.
void check_memory(const MemoryPlan& plan, const gpu::DeviceFacts& facts);

/// "12 B", "3.40 KiB", ... up to GiB.
std::string size_text(uint64_t bytes);

} // namespace onde
