#include "chapter/raster_depth_buffer.h"

#include <algorithm>

namespace onde {
namespace {

/// Launches stay short, so that Ctrl-C is heard.
constexpr uint32_t PRIMITIVES_PER_LAUNCH = 1u << 20;
constexpr uint32_t MOST_SAMPLES = 16; // of one pass

/// Primitives with larger boxes are shared out by rows, lest one work item draw them alone.
uint32_t most_small_pixels(const gpu::DeviceFacts& facts) {
    return facts.is_cpu ? 4096 : 256;
}
uint32_t rows_per_band(const gpu::DeviceFacts& facts) {
    return facts.is_cpu ? 16 : 1;
}

size_t shares(size_t count, uint32_t chunk) {
    return (count + chunk - 1) / chunk;
}

struct DepthBuffers {
    gpu::Buffer<uint64_t> nearest; ///< by pixel
    gpu::Buffer<uint32_t> large;   ///< primitives to be shared out, after their number

    DepthBuffers(RenderBuffers& buffers, const RenderOptions& options, uint32_t primitives)
        : nearest(
              buffers.film.add<uint64_t>("depth buffer", size_t(options.width) * options.height)),
          large(buffers.scene.add<uint32_t>("large primitives",
                                            1 + std::min(primitives, PRIMITIVES_PER_LAUNCH))) {}
};

class DepthBuffer : public Integrator {
  public:
    DepthBuffer(const IntegratorContext& c, DepthAtomics atomics)
        : context_(checked(c)), options_(c.options), buffers_(c.device()), scene_(c, buffers_),
          atomics_(atomics), film_(c.programs, buffers_.film, options_),
          depth_(buffers_, options_, scene_.primitives()),
          program_(build_raster(
              c, "depth_buffer.cl",
              {{"clear_depth", shares(pixels(), chunk())},
               {"draw_small", shares(depth_.large.size(), chunk())},
               {"draw_large", shares(options_.height, rows_per_band(c.device().facts()))},
               {"resolve_depth", shares(pixels(), chunk())}},
              {fmt::format("ONDE_DEPTH_ATOMICS64={:d}", atomics == DepthAtomics::wide)})) {}

    void render_pass(uint32_t first, uint32_t count,
                     const std::function<bool(double)>& keep_going) override {
        for (uint32_t sample = 0; sample < count; sample++) {
            scene_.set_sample(first + sample);
            const auto between = [&] { return keep_going(double(sample) / count); };
            film_.begin_pass(first + sample, 1, pixels());
            if (!draw_sample(between)) return;
            film_.end_wave(pixels());
            if (!keep_going(double(sample + 1) / count)) return;
        }
    }

    uint32_t max_samples() const override { return MOST_SAMPLES; }
    Film& film() override { return film_; }
    RayCounts ray_counts() const override { return {}; }
    const gpu::BuildReport& build_report() const override { return program_.report(); }
    const RenderBuffers& buffers() const override { return buffers_; }
    std::vector<std::string> findings() const override { return scene_.notes(); }

  private:
    static const IntegratorContext& checked(const IntegratorContext& context) {
        check_options(context.options);
        return context;
    }
    uint32_t pixels() const { return options_.width * options_.height; }
    uint32_t chunk() const { return options_.settings.chunk; }
    const gpu::DeviceFacts& facts() const { return context_.device().facts(); }

    /// Returns whether it was drawn to its end; else it is not on the film.
    bool draw_sample(const std::function<bool()>& keep_going) {
        clear_depth();
        const uint32_t phases = atomics_ == DepthAtomics::wide ? 1 : 2;
        for (uint32_t phase = 0; phase < phases; phase++)
            for (uint64_t first = 0; first < scene_.primitives(); first += PRIMITIVES_PER_LAUNCH) {
                draw(uint32_t(first), phase);
                if (!keep_going()) return false;
            }
        resolve();
        return true;
    }

    void clear_depth() {
        gpu::Kernel& kernel = program_.kernel("clear_depth");
        kernel.set_from(0, pixels(), chunk(), depth_.nearest);
        kernel.launch(shares(pixels(), chunk()), context_.profiler);
    }

    /// The primitives of one launch from `first` on.
    void draw(uint32_t first, uint32_t phase) {
        const uint32_t zero = 0;
        const uint32_t count = std::min(scene_.primitives() - first, PRIMITIVES_PER_LAUNCH);
        depth_.large.write(context_.device(), std::span(&zero, 1));
        gpu::Kernel& small = program_.kernel("draw_small");
        small.set_from(0, count, chunk());
        small.set_from(scene_.bind(small, 2), first, most_small_pixels(facts()), depth_.large,
                       depth_.nearest, phase);
        small.launch(shares(count, chunk()), context_.profiler);

        const uint32_t band = rows_per_band(facts());
        const auto bands = uint32_t(shares(options_.height, band));
        gpu::Kernel& large = program_.kernel("draw_large");
        large.set_from(0, bands, band);
        large.set_from(scene_.bind(large, 2), depth_.large, depth_.nearest, phase);
        large.launch(bands, context_.profiler);
        context_.device().finish();
    }

    void resolve() {
        gpu::Kernel& kernel = program_.kernel("resolve_depth");
        kernel.set(0, pixels());
        const uint32_t next = kernel.set_from(scene_.bind_scene(kernel, 1), chunk());
        kernel.set_from(scene_.bind(kernel, next), depth_.nearest, film_.sums());
        kernel.launch(shares(pixels(), chunk()), context_.profiler);
        context_.device().finish();
    }

    IntegratorContext context_;
    RenderOptions options_;
    RenderBuffers buffers_;
    RasterScene scene_;
    DepthAtomics atomics_;
    Film film_;
    DepthBuffers depth_;
    gpu::Program program_;
};

} // namespace

DepthAtomics best_depth_atomics(const gpu::DeviceFacts& facts) {
    return facts.int64_atomics ? DepthAtomics::wide : DepthAtomics::narrow;
}

void plan_depth_buffer(RenderBuffers& buffers, const Scene& scene, const RenderOptions& options) {
    const PackedRaster packed = pack_raster(scene, scene.cameras.at(options.camera), options);
    RasterBuffers(buffers.scene, packed);
    DepthBuffers(buffers, options, packed.record.primitive_count);
}

std::unique_ptr<Integrator> make_depth_buffer(const IntegratorContext& context,
                                              DepthAtomics atomics) {
    return std::make_unique<DepthBuffer>(context, atomics);
}

} // namespace onde
