// Integrators whose passes are cut into waves, which an engine drives through an estimator.
#pragma once

#include "render/integrator.h"

namespace onde {

class WaveIntegrator : public Integrator {
  public:
    /// Makes the estimator, whose buffers are to be listed in those given.
    using MakeEstimator = std::function<std::unique_ptr<Estimator>(RenderBuffers&)>;

    /// What the context refers to outlives it.
    WaveIntegrator(const IntegratorContext& context, const MakeEstimator& make);

    /// At most two waves are in flight, so that the device need not wait for the host.
    void render_pass(uint32_t first, uint32_t count,
                     const std::function<bool(double)>& keep_going) override;
    uint32_t max_samples() const override;
    void clear() override;
    bool set_camera(const Camera& camera) override;
    void set_pixels(std::span<const uint32_t> pixels) override;

    Film& film() override { return film_; }
    const gpu::BuildReport& build_report() const override { return engine_->build_report(); }
    const RenderBuffers& buffers() const override { return buffers_; }
    RayCounts ray_counts() const override { return ray_counts_of(engine_->counters()); }

  protected:
    /// Once the waves of a pass are done.
    virtual void end_pass() {}

    const RenderOptions& options() const { return options_; }
    const gpu::Device& device() const { return device_; }
    const Estimator& estimator() const { return *estimator_; }
    /// Paths that were started so far.
    uint64_t paths() const { return paths_; }

  private:
    void queue_wave(const Wave& wave);
    /// Waits for a wave, and counts what its samples have seen.
    void count_ids(const Wave& wave);

    const gpu::Device& device_;
    RenderOptions options_;
    Camera camera_;
    RenderBuffers buffers_;
    Film film_;
    std::unique_ptr<Estimator> estimator_;
    std::unique_ptr<EngineDriver> engine_;
    const DeviceScene& scene_;
    std::vector<uint32_t> order_; ///< of the pixels that get samples, in films that count ids
    uint32_t pixels_;             ///< that get samples
    uint64_t paths_ = 0;
};

} // namespace onde
