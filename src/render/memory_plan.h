// What a render takes on the device, known before anything is allocated.
#pragma once

#include "gpu/buffer_list.h"

#include <string>
#include <vector>

namespace onde {

/// The sizes of a render's buffers, in three groups.
struct MemoryPlan {
    std::vector<gpu::BufferSize> scene, paths, film;

    /// Adds the buffers of a packed scene.
    void add_scene(const std::vector<gpu::BufferSize>& buffers) {
        scene.insert(scene.begin(), buffers.begin(), buffers.end());
    }
    uint64_t bytes() const {
        return gpu::total_bytes(scene) + gpu::total_bytes(paths) + gpu::total_bytes(film);
    }
};

/// The lists of an integrator's buffers, in the groups of the plan; those of the packed scene are
/// in none of them.
struct RenderBuffers {
    gpu::BufferList scene, paths, film;

    /// A plan: nothing is allocated.
    RenderBuffers() = default;
    explicit RenderBuffers(const gpu::Device& device)
        : scene(device), paths(device), film(device) {}

    MemoryPlan sizes() const { return {scene.sizes(), paths.sizes(), film.sizes()}; }
};

/// Whether every buffer, and all of them together, are what the device allows.
bool fits(const MemoryPlan& plan, const gpu::DeviceFacts& facts);

/// Throws gpu::OutOfMemory unless the plan fits, with what is needed and what there is.
void check_memory(const MemoryPlan& plan, const gpu::DeviceFacts& facts);

/// "12 B", "3.40 KiB", ... up to GiB.
std::string size_text(uint64_t bytes);

} // namespace onde
