// The wavefront as one kernel launch per stage and step, over a queue that all work items share.
#include "gpu/fence.h"
#include "render/engine.h"
#include "render/wave_memory.h"

#include <algorithm>
#include <deque>

namespace onde {
namespace {

class StagedWavefront : public EngineDriver {
  public:
    StagedWavefront(const EngineContext& context, const Estimator& estimator)
        : device_(context.device()), shape_(estimator.shape()), settings_(context.options.settings),
          profiler_(context.profiler), arguments_(context),
          memory_(context.buffers.paths, shape_, context.options),
          program_(build_engine(context, shape_, "wavefront/staged.cl", stages())) {
        for (const std::string& stage : stages()) bind(program_.kernel(stage), estimator);
    }

    void begin_picture(const Camera& camera) override { arguments_.begin_picture(camera); }
    void set_pixels(std::span<const uint32_t> pixels) override { arguments_.set_pixels(pixels); }
    /// As long as a path is alive: a step is queued before the one before it is known to have left
    /// some, so that the device need not wait for the host.
    void render_wave(const Wave& wave) override {
        for (const std::string& stage : stages())
            arguments_.set_wave(program_.kernel(stage), wave, chunk_of(stage, wave));
        launch("generate", wave, 0);
        uint32_t step = 0;
        if (shape_.connects_start) {
            launch("connect", wave, step);
            launch("extend", wave, step++);
        }
        for (std::deque<gpu::PendingWord> alive;; step++) {
            launch_step(wave, step);
            alive.emplace_back(device_, memory_.queue(), (step + 1) % 2);
            if (alive.size() < 2) continue;
            if (alive.front().wait() == 0) break;
            alive.pop_front();
        }
        launch("accumulate", wave, 0);
        arguments_.tally(program_, profiler_);
    }

    uint32_t wave_capacity() const override { return settings_.wave_size; }
    uint32_t sample_capacity() const override { return settings_.wave_size; }
    std::vector<uint64_t> counters() const override { return arguments_.counters(); }
    std::vector<uint32_t> seen(uint32_t paths) const override { return arguments_.seen(paths); }
    const gpu::BuildReport& build_report() const override { return program_.report(); }

  private:
    std::vector<std::string> stages() const {
        std::vector<std::string> names{"generate", "intersect", "shade",
                                       "connect",  "extend",    "accumulate"};
        if (shape_.is_tree) names.insert(names.end(), {"sample", "advance"});
        return names;
    }

    void bind(gpu::Kernel& kernel, const Estimator& estimator) {
        state_argument_ = estimator.bind(kernel, arguments_.bind(kernel, STEP_ARGUMENT + 1));
        queue_argument_ = memory_.bind(kernel, state_argument_);
        memory_.bind_queue(kernel, queue_argument_);
    }

    void launch_step(const Wave& wave, uint32_t step) {
        launch("intersect", wave, step);
        launch("shade", wave, step);
        launch("connect", wave, step);
        if (shape_.is_tree) {
            for (uint32_t k = 1; k < shape_.connections; k++) {
                program_.kernel("sample").set(queue_argument_ + 2, k);
                launch("sample", wave, step);
                launch("connect", wave, step);
            }
            launch("advance", wave, step);
        }
        launch("extend", wave, step);
    }

    void launch(const char* stage, const Wave& wave, uint32_t step) {
        gpu::Kernel& kernel = program_.kernel(stage);
        kernel.set(STEP_ARGUMENT, step);
        memory_.set_states(kernel, state_argument_, queue_argument_, step);
        const uint32_t chunk = chunk_of(stage, wave);
        kernel.launch((wave.paths() + chunk - 1) / chunk, profiler_);
    }

    /// A pixel's samples must be accumulated by one work item.
    uint32_t chunk_of(const std::string& stage, const Wave& wave) const {
        return stage == "accumulate" ? std::max(settings_.chunk, wave.samples) : settings_.chunk;
    }

    static constexpr uint32_t STEP_ARGUMENT = KernelArguments::LAUNCH_PARAMETER_COUNT;

    const gpu::Device& device_;
    EstimatorShape shape_;
    gpu::DeviceSettings settings_;
    gpu::Profiler* profiler_;
    KernelArguments arguments_;
    WaveMemory memory_;
    gpu::Program program_;
    uint32_t state_argument_ = 0, queue_argument_ = 0; // the same in all stages
};

} // namespace

std::unique_ptr<EngineDriver> make_staged_wavefront(const EngineContext& context,
                                                    const Estimator& estimator) {
    return std::make_unique<StagedWavefront>(context, estimator);
}

} // namespace onde
