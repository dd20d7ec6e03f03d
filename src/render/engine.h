// How a wave of paths is driven through the kernels. Three ways: staged and fused wavefront, and
// the megakernel. They make the same picture, bit for bit.
#pragma once

#include "gpu/program.h"
#include "render/film.h"
#include "render/memory_plan.h"
#include "render/options.h"
#include "upload/device_scene.h"

#include "shared/frame.h"

#include <memory>
#include <string>
#include <vector>

namespace onde {

/// A wave: `pixels` entries of the pixel order from `first_pixel`, and of each pixel the samples
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

    JobBuffers(gpu::BufferList& buffers, const RenderOptions& options);
};

/// The parameters that all kernels of all engines share, and their places.
class KernelArguments {
  public:
    explicit KernelArguments(const EngineContext& context);

    /// Binds all but `count` and the wave; returns the first index after them.
    uint32_t bind(gpu::Kernel& kernel) const;
    /// Sets `count` and the wave.
    void set_wave(gpu::Kernel& kernel, const Wave& wave, uint32_t chunk) const;
    /// Adds the wave's counters to the totals.
    void tally(gpu::Program& program, gpu::Profiler* profiler) const;

    /// Totals by [row * COUNTER_BOUNCES + bounce].
    std::vector<uint64_t> counters() const;

  private:
    // The order of kernel parameters: count, frame, 13 of the scene, 4 buffers of the job, then
    // chunk, first_pixel, first_sample, log2_samples.
    static constexpr uint32_t FIRST_WAVE_ARGUMENT = 19, WAVE_ARGUMENTS = 4;

    const gpu::Device& device_;
    const DeviceScene& scene_;
    const Film& film_;
    JobBuffers job_;
};

class EngineDriver {
  public:
    virtual ~EngineDriver() = default;

    /// Queues the work of one wave; adds its radiance to the film.
    virtual void render_wave(const Wave& wave) = 0;
    /// The most paths a wave may have.
    virtual uint32_t wave_capacity() const = 0;
    /// The most samples of one pixel a wave may have.
    virtual uint32_t sample_capacity() const = 0;
    virtual std::vector<uint64_t> counters() const = 0;
    virtual const gpu::BuildReport& build_report() const = 0;
};

std::unique_ptr<EngineDriver> make_staged_wavefront(const EngineContext& context);
std::unique_ptr<EngineDriver> make_fused_wavefront(const EngineContext& context);
std::unique_ptr<EngineDriver> make_megakernel(const EngineContext& context);

/// States the buffers of an engine of these options.
void plan_engine(RenderBuffers& buffers, const RenderOptions& options);

/// The engine that the options name.
std::unique_ptr<EngineDriver> make_engine(const EngineContext& context);

/// The program `file` with the scene's, the settings' and the device's definitions and
/// `more_defines`, and `tally`.
gpu::Program build_engine(const EngineContext& context, const std::string& file,
                          const std::vector<std::string>& kernels,
                          const std::vector<std::string>& more_defines = {});

} // namespace onde
