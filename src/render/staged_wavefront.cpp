// The wavefront as one kernel launch per stage and bounce.
#include "render/engine.h"
#include "render/wave_memory.h"

#include <algorithm>

namespace onde {
namespace {

class StagedWavefront : public EngineDriver {
  public:
    explicit StagedWavefront(const EngineContext& context)
        : settings_(context.options.settings), depth_(context.options.depth),
          profiler_(context.profiler), arguments_(context),
          memory_(context.buffers.paths, settings_),
          program_(build_engine(
              context, "wavefront/staged.cl",
              {"generate", "intersect", "shade", "shadow_test", "extend", "accumulate"})) {}

    void render_wave(const Wave& wave) override {
        launch("generate", wave, 0);
        for (uint32_t bounce = 0; bounce < depth_; bounce++) {
            launch("intersect", wave, bounce);
            launch("shade", wave, bounce);
            launch("shadow_test", wave, bounce);
            launch("extend", wave, bounce);
        }
        launch("accumulate", wave, 0);
        arguments_.tally(program_, profiler_);
    }

    uint32_t wave_capacity() const override { return settings_.wave_size; }
    uint32_t sample_capacity() const override { return settings_.wave_size; }
    std::vector<uint64_t> counters() const override { return arguments_.counters(); }
    const gpu::BuildReport& build_report() const override { return program_.report(); }

  private:
    void launch(const char* stage, const Wave& wave, uint32_t bounce) {
        gpu::Kernel& kernel = program_.kernel(stage);
        const bool swapped = settings_.queue == gpu::QueueKind::global && bounce % 2;
        memory_.bind(kernel, arguments_.bind(kernel), bounce, swapped);
        const uint32_t chunk = chunk_of(kernel, wave);
        arguments_.set_wave(kernel, wave, chunk);
        kernel.launch((wave.paths() + chunk - 1) / chunk, profiler_);
    }

    /// A pixel's samples must be accumulated by one work item.
    uint32_t chunk_of(const gpu::Kernel& kernel, const Wave& wave) const {
        const bool whole_pixels = kernel.name() == "accumulate";
        return whole_pixels ? std::max(settings_.chunk, wave.samples) : settings_.chunk;
    }

    gpu::DeviceSettings settings_;
    uint32_t depth_;
    gpu::Profiler* profiler_;
    KernelArguments arguments_;
    WaveMemory memory_;
    gpu::Program program_;
};

} // namespace

std::unique_ptr<EngineDriver> make_staged_wavefront(const EngineContext& context) {
    return std::make_unique<StagedWavefront>(context);
}

} // namespace onde
