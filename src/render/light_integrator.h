// The light tracer: paths from the lights, every vertex connected to the camera.
#pragma once

#include "render/integrator.h"

#include "shared/light_tracing.h"

namespace onde {

/// What became of the emitted rays so far.
struct LightCounts {
    uint64_t emitted = 0;     ///< paths that started at a light
    uint64_t contributed = 0; ///< of them, those that met a surface which then added to a pixel
    uint64_t connections = 0; ///< rays toward the camera
    uint64_t unblocked = 0;   ///< of them, those with nothing in between
};

/// The buffers of light tracing, beside those of all integrators.
struct LightBuffers {
    gpu::Buffer<uint32_t> splats, statistics;
    gpu::Buffer<LightTracingRecord> setup;
    gpu::Buffer<float> state;

    LightBuffers(RenderBuffers& buffers, const RenderOptions& options);
};

/// States the buffers of a light tracer of these options.
void plan_light_integrator(RenderBuffers& buffers, const RenderOptions& options);

class LightIntegrator : public Integrator {
  public:
    /// Throws InputError for a scene in which nothing emits.
    explicit LightIntegrator(const IntegratorContext& context);

    void render_pass(uint32_t first, uint32_t count,
                     const std::function<bool(double)>& keep_going) override;
    uint32_t max_samples() const override;
    Film& film() override { return film_; }
    RayCounts ray_counts() const override;
    const gpu::BuildReport& build_report() const override { return program_.report(); }
    const RenderBuffers& buffers() const override { return buffers_; }
    std::vector<std::string> findings() const override;

    LightCounts counts() const;

  private:
    void trace_wave(const Wave& wave);
    void resolve();
    std::vector<uint64_t> statistics() const;

    const gpu::Device& device_;
    RenderOptions options_;
    gpu::Profiler* profiler_;
    bool has_mirrors_;
    uint64_t hidden_emitters_;
    RenderBuffers buffers_;
    Film film_;
    LightBuffers light_;
    float splat_scale_;
    KernelArguments arguments_;
    gpu::Program program_;
    uint64_t emitted_ = 0;
};

} // namespace onde
