// The wavefront as one launch per wave: each work item takes its chunk of paths through all stages.
#include "render/engine.h"
#include "render/wave_memory.h"

namespace onde {
namespace {

class FusedWavefront : public EngineDriver {
  public:
    explicit FusedWavefront(const EngineContext& context)
        : settings_(context.options.settings), profiler_(context.profiler), arguments_(context),
          memory_(context.device, settings_),
          program_(build_engine(context, "wavefront/fused.cl", {"fused"})) {
        gpu::Kernel& kernel = program_.kernel("fused");
        memory_.bind(kernel, arguments_.bind(kernel), 0, false);
    }

    void render_wave(const Wave& wave) override {
        gpu::Kernel& kernel = program_.kernel("fused");
        arguments_.set_wave(kernel, wave, settings_.chunk);
        kernel.launch((wave.paths() + settings_.chunk - 1) / settings_.chunk, profiler_);
        arguments_.tally(program_, profiler_);
    }

    uint32_t wave_capacity() const override { return settings_.wave_size; }
    uint32_t sample_capacity() const override { return settings_.chunk; }
    std::vector<uint64_t> counters() const override { return arguments_.counters(); }
    const gpu::BuildReport& build_report() const override { return program_.report(); }
    uint64_t state_bytes() const override { return memory_.bytes(); }

  private:
    gpu::DeviceSettings settings_;
    gpu::Profiler* profiler_;
    KernelArguments arguments_;
    WaveMemory memory_;
    gpu::Program program_;
};

} // namespace

std::unique_ptr<EngineDriver> make_fused_wavefront(const EngineContext& context) {
    return std::make_unique<FusedWavefront>(context);
}

} // namespace onde
