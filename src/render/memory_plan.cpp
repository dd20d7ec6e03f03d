#include "render/memory_plan.h"

#include "gpu/buffer.h"

#include <algorithm>

namespace onde {
namespace {

void check_buffers(const std::vector<gpu::BufferSize>& buffers, const char* remedy,
                   const gpu::DeviceFacts& facts) {
    for (const gpu::BufferSize& buffer : buffers)
        if (buffer.bytes > facts.max_allocation)
            throw gpu::OutOfMemory("the {} take {} in one buffer, but {} allows {}; {}",
                                   buffer.name, size_text(buffer.bytes), facts.name,
                                   size_text(facts.max_allocation), remedy);
}

} // namespace

bool fits(const MemoryPlan& plan, const gpu::DeviceFacts& facts) {
    const auto allowed = [&](const std::vector<gpu::BufferSize>& buffers) {
        return std::ranges::all_of(buffers, [&](const gpu::BufferSize& buffer) {
            return buffer.bytes <= facts.max_allocation;
        });
    };
    return allowed(plan.scene) && allowed(plan.paths) && allowed(plan.film) &&
           plan.bytes() <= facts.global_memory;
}

void check_memory(const MemoryPlan& plan, const gpu::DeviceFacts& facts) {
    check_buffers(plan.scene, "use a smaller scene", facts);
    check_buffers(plan.paths, "use a smaller --wave-size", facts);
    check_buffers(plan.film, "use a smaller --size", facts);
    if (plan.bytes() <= facts.global_memory) return;
    throw gpu::OutOfMemory(
        "the render takes {} (scene {}, paths in flight {}, film {}), but {} has {}; "
        "use a smaller scene, --texture-memory, --wave-size or --size",
        size_text(plan.bytes()), size_text(gpu::total_bytes(plan.scene)),
        size_text(gpu::total_bytes(plan.paths)), size_text(gpu::total_bytes(plan.film)), facts.name,
        size_text(facts.global_memory));
}

std::string size_text(uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    constexpr const char* UNITS[] = {"KiB", "MiB", "GiB", "TiB"};
    double value = double(bytes) / 1024;
    size_t unit = 0;
    for (; value >= 1024 && unit < 3; unit++) value /= 1024;
    return fmt::format("{:.2f} {}", value, UNITS[unit]);
}

} // namespace onde
