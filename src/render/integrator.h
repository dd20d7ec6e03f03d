// What renders a picture: a scene, a device and options in, samples on a film out.
#pragma once

#include "render/engine.h"

#include <functional>
#include <memory>
#include <span>

namespace onde {

/// Numbers of a render so far.
struct RayCounts {
    std::vector<uint64_t> extension, shadow; ///< by bounce, trailing zeros cut off
    uint64_t total() const;
};

class Integrator {
  public:
    virtual ~Integrator() = default;

    /// Adds samples first .. first + count - 1 of every pixel to the film, or the rest of them
    /// after an interruption; see Film::begin_pass. `count` must be a power of two; more than
    /// max_samples() are added in several steps. Calls `keep_going` between waves with the share of
    /// the pass that is done, and stops early when it returns false.
    virtual void render_pass(uint32_t first, uint32_t count,
                             const std::function<bool(double)>& keep_going) = 0;
    virtual uint32_t max_samples() const = 0;

    /// Begins anew: an empty film, and nothing counted.
    virtual void clear() { film().clear(); }
    /// The same with another camera. False, with nothing done, where that takes another integrator.
    virtual bool set_camera(const Camera&) { return false; }
    /// From the next pass on, samples go to these pixels alone (x | y << 16), in this order; no
    /// more than the film has. At first they are those of the options' rectangle, or all. Only of
    /// integrators whose samples are each of one pixel.
    virtual void set_pixels(std::span<const uint32_t>) {}

    virtual Film& film() = 0;
    virtual RayCounts ray_counts() const = 0;
    virtual const gpu::BuildReport& build_report() const = 0;
    /// What was allocated for the render, beside the device scene.
    virtual const RenderBuffers& buffers() const = 0;
    /// What the integrator has to say about the render at its end, a sentence each.
    virtual std::vector<std::string> findings() const { return {}; }
};

/// What an integrator is made from; the referenced objects outlive it.
struct IntegratorContext {
    gpu::Programs& programs;
    const Scene* description; ///< for all but path tracing, where it may be null
    const DeviceScene& scene; ///< of the same description
    const Camera& camera;
    const RenderOptions& options;
    gpu::Profiler* profiler = nullptr; ///< null: launches are not timed

    const gpu::Device& device() const { return programs.device(); }
};

/// Ray statistics from a table of counters by [row * COUNTER_BOUNCES + bounce].
RayCounts ray_counts_of(const std::vector<uint64_t>& counters);

/// The light tracer (see render/light_integrator.h).
std::unique_ptr<Integrator> make_light_integrator(const IntegratorContext& context);

} // namespace onde
