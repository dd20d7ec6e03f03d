// Engines of one launch per wave: the fused wavefront, in which each work item takes its chunk of
// paths through all stages, and the megakernel, which keeps them in registers.
#include "render/engine.h"
#include "render/wave_memory.h"

#include <optional>

namespace onde {
namespace {

class SingleLaunch : public EngineDriver {
  public:
    SingleLaunch(const EngineContext& context, const Estimator& estimator, const std::string& file,
                 const std::string& kernel, bool has_state)
        : settings_(context.options.settings), profiler_(context.profiler), arguments_(context),
          program_(build_engine(context, estimator.shape(), file, {kernel})),
          kernel_(program_.kernel(kernel)) {
        const uint32_t after = estimator.bind(kernel_, arguments_.bind(kernel_));
        if (!has_state) return;
        memory_.emplace(context.buffers.paths, estimator.shape(), context.options);
        memory_->bind(kernel_, after);
    }

    void begin_picture(const Camera& camera) override { arguments_.begin_picture(camera); }
    void set_pixels(std::span<const uint32_t> pixels) override { arguments_.set_pixels(pixels); }
    void render_wave(const Wave& wave) override {
        arguments_.set_wave(kernel_, wave, settings_.chunk);
        kernel_.launch((wave.paths() + settings_.chunk - 1) / settings_.chunk, profiler_);
        arguments_.tally(program_, profiler_);
    }

    uint32_t wave_capacity() const override { return settings_.wave_size; }
    uint32_t sample_capacity() const override { return settings_.chunk; }
    std::vector<uint64_t> counters() const override { return arguments_.counters(); }
    std::vector<uint32_t> seen(uint32_t paths) const override { return arguments_.seen(paths); }
    const gpu::BuildReport& build_report() const override { return program_.report(); }

  private:
    gpu::DeviceSettings settings_;
    gpu::Profiler* profiler_;
    KernelArguments arguments_;
    std::optional<WaveMemory> memory_; // of the fused wavefront
    gpu::Program program_;
    gpu::Kernel& kernel_; // in program_
};

} // namespace

std::unique_ptr<EngineDriver> make_fused_wavefront(const EngineContext& context,
                                                   const Estimator& estimator) {
    return std::make_unique<SingleLaunch>(context, estimator, "wavefront/fused.cl", "fused", true);
}

std::unique_ptr<EngineDriver> make_megakernel(const EngineContext& context,
                                              const Estimator& estimator) {
    return std::make_unique<SingleLaunch>(context, estimator, "megakernel/megakernel.cl",
                                          "megakernel", false);
}

} // namespace onde
