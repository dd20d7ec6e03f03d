#include "render/memory_plan.h"

#include "core/error.h"
#include "render/light_tracing_setup.h"
#include "render/tree_memory.h"
#include "render/wave_memory.h"
#include "shared/light_tracing.h"

namespace onde {
namespace {

void check_buffers(const std::vector<BufferSize>& buffers, const char* remedy,
                   const gpu::DeviceFacts& facts) {
    for (const BufferSize& buffer : buffers)
        if (buffer.bytes > facts.max_allocation)
            throw DeviceError("the {} take {} in one buffer, but {} allows {}; {}", buffer.name,
                              size_text(buffer.bytes), facts.name, size_text(facts.max_allocation),
                              remedy);
}

} // namespace

MemoryPlan plan_memory(const RenderOptions& options) {
    const uint64_t pixels = uint64_t(options.width) * options.height;
    MemoryPlan plan;
    plan.film = {{"film sums", pixels * sizeof(cl_float4)},
                 {"pixel order", pixels * sizeof(uint32_t)}};
    if (options.integrator == IntegratorKind::light) {
        plan.film.push_back({"splats", pixels * SPLAT_WORDS * sizeof(uint32_t)});
        plan.paths = {{"light paths", light_state_size(options.settings) * sizeof(float)}};
    } else if (options.integrator == IntegratorKind::depth_buffer)
        plan.film.push_back({"depth buffer", pixels * sizeof(uint64_t)});
    else if (options.integrator == IntegratorKind::painter)
        plan.film.push_back({"canvas", pixels * sizeof(cl_float4)});
    else if (options.integrator == IntegratorKind::whitted)
        plan.paths = TreeMemory::plan(options);
    else if (options.engine == Engine::wavefront)
        plan.paths = WaveMemory::plan(options.settings);
    return plan;
}

void check_memory(const MemoryPlan& plan, const gpu::DeviceFacts& facts) {
    check_buffers(plan.scene, "use a smaller scene", facts);
    check_buffers(plan.paths, "use a smaller --wave-size", facts);
    check_buffers(plan.film, "use a smaller --size", facts);
    if (plan.bytes() <= facts.global_memory) return;
    throw DeviceError("the render takes {} (scene {}, paths in flight {}, film {}), but {} has {}; "
                      "use a smaller scene, --wave-size or --size",
                      size_text(plan.bytes()), size_text(total_bytes(plan.scene)),
                      size_text(total_bytes(plan.paths)), size_text(total_bytes(plan.film)),
                      facts.name, size_text(facts.global_memory));
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
