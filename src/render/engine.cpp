#include "render/engine.h"

#include "render/frame.h"
#include "render/wave_memory.h"

#include <algorithm>
#include <bit>

namespace onde {

JobBuffers::JobBuffers(gpu::BufferList& buffers, const RenderOptions& options)
    : frame(buffers.add<FrameRecord>("frame", 1)),
      counters(buffers.add_filled("ray counters", COUNTER_SIZE, uint32_t(0))),
      totals(buffers.add_filled("ray totals", COUNTER_SIZE, uint64_t(0))),
      pixel_order(buffers.add<uint32_t>("pixel order", size_t(options.width) * options.height)) {}

KernelArguments::KernelArguments(const EngineContext& context)
    : device_(context.device()), scene_(context.scene), film_(context.film),
      job_(context.buffers.film, context.options) {
    const RenderOptions& options = context.options;
    const FrameRecord frame = make_frame(context.scene.packed(), context.camera, options);
    job_.frame.write(device_, std::span(&frame, 1));
    job_.pixel_order.write(device_, pixel_order(options.width, options.height));
}

uint32_t KernelArguments::bind(gpu::Kernel& kernel) const {
    kernel.set(0, uint32_t(0));
    kernel.set(1, job_.frame);
    const uint32_t job = scene_.bind(kernel, 2);
    const uint32_t wave =
        kernel.set_from(job, job_.counters, film_.invalid(), film_.sums(), job_.pixel_order);
    return wave + WAVE_ARGUMENTS;
}

void KernelArguments::set_wave(gpu::Kernel& kernel, const Wave& wave, uint32_t chunk) const {
    kernel.set(0, wave.paths());
    kernel.set_from(FIRST_WAVE_ARGUMENT, chunk, wave.first_pixel, wave.first_sample,
                    uint32_t(std::countr_zero(wave.samples)));
}

void KernelArguments::tally(gpu::Program& program, gpu::Profiler* profiler) const {
    gpu::Kernel& kernel = program.kernel("tally");
    kernel.set_from(0, uint32_t(COUNTER_SIZE), job_.counters, job_.totals);
    kernel.launch(COUNTER_SIZE, profiler);
}

std::vector<uint64_t> KernelArguments::counters() const {
    return job_.totals.read(device_);
}

gpu::Program build_engine(const EngineContext& context, const std::string& file,
                          const std::vector<std::string>& kernels,
                          const std::vector<std::string>& more_defines) {
    const gpu::DeviceSettings& settings = context.options.settings;
    gpu::ProgramRequest request;
    request.file = file;
    request.defines = context.scene.packed().features.defines();
    request.defines.push_back(fmt::format("ONDE_WIDTH={}", settings.width));
    request.defines.push_back(
        fmt::format("ONDE_GLOBAL_QUEUE={:d}", settings.queue == gpu::QueueKind::global));
    // The megakernel's groups are its lanes, and packets want 16.
    const bool can_fill = context.options.engine == Engine::wavefront || settings.width == 16;
    request.defines.push_back(
        fmt::format("ONDE_PRIMARY_PACKETS={:d}", settings.primary_packets && can_fill));
    request.defines.push_back(
        fmt::format("ONDE_INTERLEAVE={:d}", context.scene.bvh_bytes() > settings.interleave_above));
    request.defines.insert(request.defines.end(), more_defines.begin(), more_defines.end());
    const RenderOptions& options = context.options;
    const uint64_t frame = uint64_t(options.width) * options.height * options.samples_in_flight;
    const size_t items = std::min<uint64_t>(settings.wave_size, frame) / settings.chunk;
    for (const std::string& name : kernels)
        request.kernels.push_back({name, settings.local_size, items});
    request.kernels.push_back({"tally", settings.local_size, COUNTER_SIZE});
    return context.programs.build(request);
}

void plan_engine(RenderBuffers& buffers, const RenderOptions& options) {
    JobBuffers(buffers.film, options);
    if (options.engine == Engine::wavefront) WaveMemory(buffers.paths, options.settings);
}

std::unique_ptr<EngineDriver> make_engine(const EngineContext& context) {
    if (context.options.engine == Engine::megakernel) return make_megakernel(context);
    if (context.options.settings.launch == gpu::Launch::fused) return make_fused_wavefront(context);
    return make_staged_wavefront(context);
}

} // namespace onde
