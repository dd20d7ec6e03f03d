#include "render/engine.h"

#include "render/frame.h"
#include "render/wave_memory.h"
#include "shared/aovs.h"

#include <algorithm>
#include <bit>

namespace onde {

JobBuffers::JobBuffers(gpu::BufferList& buffers, const RenderOptions& options)
    : frame(buffers.add<FrameRecord>("frame", 1 + (options.aovs >> AOV_MOTION & 1))),
      counters(buffers.add<uint32_t>("ray counters", COUNTER_SIZE)),
      totals(buffers.add<uint64_t>("ray totals", COUNTER_SIZE)),
      pixel_order(buffers.add<uint32_t>("pixel order", size_t(options.width) * options.height)) {
    if (options.ids)
        seen = buffers.add<uint32_t>("first hits", size_t(options.settings.wave_size) * SEEN_WORDS);
}

KernelArguments::KernelArguments(const EngineContext& context)
    : device_(context.device()), scene_(context.scene), film_(context.film),
      options_(context.options), job_(context.buffers.film, context.options) {
    job_.pixel_order.write(device_, pixel_order(options_.width, options_.height));
    begin_picture(context.camera);
}

void KernelArguments::begin_picture(const Camera& camera) {
    const std::vector<FrameRecord> frames = make_frames(scene_.packed(), camera, options_);
    job_.frame.write(device_, std::span<const FrameRecord>(frames));
    job_.counters.fill(device_, 0u);
    job_.totals.fill(device_, uint64_t(0));
}

uint32_t KernelArguments::bind(gpu::Kernel& kernel, uint32_t first) const {
    kernel.set(first, job_.frame);
    const uint32_t job = scene_.bind(kernel, first + 1);
    const uint32_t next =
        kernel.set_from(job, job_.counters, film_.invalid(), film_.sums(), job_.pixel_order);
    return options_.ids ? kernel.set_from(next, job_.seen) : next;
}

void KernelArguments::set_wave(gpu::Kernel& kernel, const Wave& wave, uint32_t chunk) const {
    kernel.set_from(0, wave.paths(), chunk, wave.first_pixel, wave.first_sample,
                    uint32_t(std::countr_zero(wave.samples)));
}

void KernelArguments::tally(gpu::Program& program, gpu::Profiler* profiler) const {
    gpu::Kernel& kernel = program.kernel("tally");
    kernel.set_from(0, uint32_t(COUNTER_SIZE), job_.counters, job_.totals);
    kernel.launch(COUNTER_SIZE, profiler);
}

std::vector<uint32_t> KernelArguments::seen(uint32_t paths) const {
    return job_.seen.read(device_, 0, size_t(paths) * SEEN_WORDS);
}

std::vector<uint64_t> KernelArguments::counters() const {
    return job_.totals.read(device_);
}

gpu::Program build_engine(const EngineContext& context, const EstimatorShape& estimator,
                          const std::string& file, const std::vector<std::string>& kernels) {
    const RenderOptions& options = context.options;
    const gpu::DeviceSettings& settings = options.settings;
    const SceneFeatures& features = context.scene.packed().features;
    gpu::ProgramRequest request{.file = file,
                                .defines = features.defines(),
                                .kernels = {},
                                .before = {layout_file(features.layout), estimator.file}};
    request.defines.push_back(fmt::format("ONDE_WIDTH={}", settings.width));
    request.defines.push_back(
        fmt::format("ONDE_INTERLEAVE={:d}", context.scene.bvh_bytes() > settings.interleave_above));
    request.defines.push_back(fmt::format("ONDE_AOVS={}", options.aovs));
    request.defines.push_back(fmt::format("ONDE_GROUPS={}", options.light_groups.size()));
    request.defines.push_back(fmt::format("ONDE_IDS={:d}", options.ids));
    request.defines.push_back(
        fmt::format("ONDE_BACKGROUND={:d}", options.background == Background::environment));
    request.defines.insert(request.defines.end(), estimator.defines.begin(),
                           estimator.defines.end());
    const uint64_t frame = uint64_t(options.width) * options.height * options.samples_in_flight;
    const size_t items = std::min<uint64_t>(settings.wave_size, frame) / settings.chunk;
    for (const std::string& name : kernels)
        request.kernels.push_back({name, settings.local_size, items});
    request.kernels.push_back({"tally", settings.local_size, COUNTER_SIZE});
    return context.programs.build(request);
}

void plan_engine(RenderBuffers& buffers, const EstimatorShape& estimator,
                 const RenderOptions& options) {
    JobBuffers(buffers.film, options);
    if (options.engine == Engine::wavefront) WaveMemory(buffers.paths, estimator, options);
}

std::unique_ptr<EngineDriver> make_engine(const EngineContext& context,
                                          const Estimator& estimator) {
    if (context.options.engine == Engine::megakernel) return make_megakernel(context, estimator);
    if (context.options.settings.launch == gpu::Launch::fused)
        return make_fused_wavefront(context, estimator);
    return make_staged_wavefront(context, estimator);
}

} // namespace onde
