// The light tracer: paths from the lights, every vertex connected to the camera.
#pragma once

#include "render/wave_integrator.h"

#include "shared/light_tracing.h"

namespace onde {

/// What became of the emitted rays so far.
struct LightCounts {
    uint64_t emitted = 0;     ///< paths that started at a light
    uint64_t contributed = 0; ///< of them, those that met a surface which then added to a pixel
    uint64_t connections = 0; ///< rays toward the camera
    uint64_t unblocked = 0;   ///< of them, those with nothing in between
};

/// The light tracer's half of kernels/light_tracing/estimator.h.
class LightEstimator : public Estimator {
  public:
    LightEstimator(RenderBuffers& buffers, const Scene& scene, const SceneFeatures& features,
                   const RenderOptions& options);

    const EstimatorShape& shape() const override { return shape_; }
    uint32_t bind(gpu::Kernel& kernel, uint32_t first) const override;
    void clear(const gpu::Device& device) override { statistics_.fill(device, 0u); }

    const gpu::Buffer<uint32_t>& splats() const { return splats_; }
    /// What one unit of a splat's fixed point stands for.
    float splat_unit() const { return 1.0f / setup_.splat_scale; }
    /// By LIGHT_CONTRIBUTED, ...
    std::vector<uint64_t> statistics(const gpu::Device& device) const;

  private:
    EstimatorShape shape_;
    LightTracingRecord setup_;
    gpu::Buffer<LightTracingRecord> on_device_;
    gpu::Buffer<uint32_t> splats_, statistics_;
};

class LightIntegrator : public WaveIntegrator {
  public:
    /// Throws InputError for a scene in which nothing emits.
    explicit LightIntegrator(const IntegratorContext& context);

    std::vector<std::string> findings() const override;
    LightCounts counts() const;

  private:
    /// Makes the film from the splats.
    void end_pass() override;

    gpu::Profiler* profiler_;
    bool has_mirrors_;
    uint64_t hidden_emitters_;
    const LightEstimator& light_;
    gpu::Program resolve_;
};

} // namespace onde
