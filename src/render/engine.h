// How a wave of paths is driven through the kernels, whatever the estimator. Three schedulers:
// staged and fused wavefront, and the megakernel. They make the same picture, bit for bit.
#pragma once

#include "gpu/program.h"
#include "render/estimator.h"
#include "render/film.h"
#include "render/memory_plan.h"
#include "render/options.h"
#include "upload/device_scene.h"

#include "shared/frame.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace onde {

/// A wave: `pixels` entries of the list of pixels from `first_pixel`, and of each pixel the samples
/// first_sample .. first_sample + samples - 1; `samples` is a power of two.
struct Wave {
    uint32_t first_pixel = 0, pixels = 0;
    uint32_t first_sample = 0, samples = 1;

    uint32_t paths() const { return pixels * samples; }
};

/// What every engine needs; the referenced objects outlive it.
struct EngineContext {
    gpu::Programs& programs;
    RenderBuffers& buffers; ///< in which the engine's are listed
    const DeviceScene& scene;
    const Film& film;
    const Camera& camera;
    const RenderOptions& options;
    gpu::Profiler* profiler; ///< null: launches are not timed

    const gpu::Device& device() const { return programs.device(); }
};

/// The buffers of a picture that all engines have, beside the film.
struct JobBuffers {
    gpu::Buffer<FrameRecord> frame;
    gpu::Buffer<uint32_t> counters;
    gpu::Buffer<uint64_t> totals;
    gpu::Buffer<uint32_t> pixel_order;
    gpu::Buffer<uint32_t> seen; ///< of films that count ids

    JobBuffers(gpu::BufferList& buffers, const RenderOptions& options);
};

/// The parameters that all kernels of all engines share, and their places.
class KernelArguments {
  public:
    static constexpr uint32_t LAUNCH_PARAMETER_COUNT = 5;

    explicit KernelArguments(const EngineContext& context);

    /// What is bound is the frame of this camera from now on; nothing is counted yet.
    void begin_picture(const Camera& camera);

    /// Waves are of these pixels from now on (x | y << 16), no more than the film has.
    void set_pixels(std::span<const uint32_t> pixels) { job_.pixel_order.write(device_, pixels); }

    /// Binds SCENE_PARAMETERS and JOB_PARAMETERS from argument `first` on; returns the next index.
    uint32_t bind(gpu::Kernel& kernel, uint32_t first = LAUNCH_PARAMETER_COUNT) const;
    /// Sets LAUNCH_PARAMETERS, which come first.
    void set_wave(gpu::Kernel& kernel, const Wave& wave, uint32_t chunk) const;
    /// Adds the wave's counters to the totals.
    void tally(gpu::Program& program, gpu::Profiler* profiler) const;

    /// Totals by [row * COUNTER_BOUNCES + bounce].
    std::vector<uint64_t> counters() const;
    /// What the first paths of the last wave have met, SEEN_WORDS each; see options.ids.
    std::vector<uint32_t> seen(uint32_t paths) const;

  private:
    const gpu::Device& device_;
    const DeviceScene& scene_;
    const Film& film_;
    const RenderOptions& options_;
    JobBuffers job_;
};

class EngineDriver {
  public:
    virtual ~EngineDriver() = default;

    /// Waves are of the picture of this camera from now on.
    virtual void begin_picture(const Camera& camera) = 0;
    /// Waves are of these pixels from now on; see KernelArguments.
    virtual void set_pixels(std::span<const uint32_t> pixels) = 0;
    /// Queues the work of one wave; adds its radiance to the film.
    virtual void render_wave(const Wave& wave) = 0;
    /// The most paths a wave may have.
    virtual uint32_t wave_capacity() const = 0;
    /// The most samples of one pixel a wave may have.
    virtual uint32_t sample_capacity() const = 0;
    virtual std::vector<uint64_t> counters() const = 0;
    /// Of the last wave; see KernelArguments.
    virtual std::vector<uint32_t> seen(uint32_t paths) const = 0;
    virtual const gpu::BuildReport& build_report() const = 0;
};

std::unique_ptr<EngineDriver> make_staged_wavefront(const EngineContext& context,
                                                    const Estimator& estimator);
std::unique_ptr<EngineDriver> make_fused_wavefront(const EngineContext& context,
                                                   const Estimator& estimator);
std::unique_ptr<EngineDriver> make_megakernel(const EngineContext& context,
                                              const Estimator& estimator);

/// The engine that the options name, around an estimator, which outlives it.
std::unique_ptr<EngineDriver> make_engine(const EngineContext& context, const Estimator& estimator);

/// States the buffers of an engine of these options, but for the estimator's own.
void plan_engine(RenderBuffers& buffers, const EstimatorShape& estimator,
                 const RenderOptions& options);

/// The program `file` behind the texts of the scene's layout and the estimator, with the scene's,
/// the settings' and the estimator's definitions, and `tally`.
gpu::Program build_engine(const EngineContext& context, const EstimatorShape& estimator,
                          const std::string& file, const std::vector<std::string>& kernels);

} // namespace onde
