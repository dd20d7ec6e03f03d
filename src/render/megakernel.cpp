// Whole paths in one kernel, for comparison and where it is faster.
#include "render/engine.h"

namespace onde {
namespace {

class Megakernel : public EngineDriver {
  public:
    explicit Megakernel(const EngineContext& context)
        : settings_(context.options.settings), profiler_(context.profiler), arguments_(context),
          program_(build_engine(context, "megakernel/megakernel.cl", {"megakernel"})) {
        arguments_.bind(program_.kernel("megakernel"));
    }

    void render_wave(const Wave& wave) override {
        gpu::Kernel& kernel = program_.kernel("megakernel");
        arguments_.set_wave(kernel, wave, settings_.chunk);
        kernel.launch((wave.paths() + settings_.chunk - 1) / settings_.chunk, profiler_);
        arguments_.tally(program_, profiler_);
    }

    uint32_t wave_capacity() const override { return settings_.wave_size; }
    uint32_t sample_capacity() const override { return settings_.chunk; }
    std::vector<uint64_t> counters() const override { return arguments_.counters(); }
    const gpu::BuildReport& build_report() const override { return program_.report(); }
    uint64_t state_bytes() const override { return 0; }

  private:
    gpu::DeviceSettings settings_;
    gpu::Profiler* profiler_;
    KernelArguments arguments_;
    gpu::Program program_;
};

} // namespace

std::unique_ptr<EngineDriver> make_megakernel(const EngineContext& context) {
    return std::make_unique<Megakernel>(context);
}

} // namespace onde
