#include "render/wave_integrator.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace onde {

uint64_t RayCounts::total() const {
    return std::accumulate(extension.begin(), extension.end(), uint64_t(0)) +
           std::accumulate(shadow.begin(), shadow.end(), uint64_t(0));
}

static std::vector<uint64_t> counter_row(const std::vector<uint64_t>& table, uint32_t index) {
    const auto begin = table.begin() + index * COUNTER_BOUNCES;
    std::vector<uint64_t> counts(begin, begin + COUNTER_BOUNCES);
    while (!counts.empty() && counts.back() == 0) counts.pop_back();
    return counts;
}

RayCounts ray_counts_of(const std::vector<uint64_t>& counters) {
    return {counter_row(counters, COUNTER_EXTENSION), counter_row(counters, COUNTER_SHADOW)};
}

namespace {

class WaveIntegrator : public Integrator {
  public:
    WaveIntegrator(const IntegratorContext& c, const EngineFactory& make)
        : device_(c.device()), options_(checked(c.options)), buffers_(c.device()),
          film_(c.programs, buffers_.film, options_),
          engine_(make({c.programs, buffers_, c.scene, film_, c.camera, options_, c.profiler})) {}

    void render_pass(uint32_t first, uint32_t count,
                     const std::function<bool(double)>& keep_going) override {
        const uint32_t pixels = options_.width * options_.height;
        const uint32_t step = std::min(count, max_samples());
        const uint32_t pixels_per_wave = engine_->wave_capacity() / step;
        for (uint32_t begin = film_.begin_pass(first, count), end = 0; begin < pixels;
             begin = end) {
            end = std::min(begin + pixels_per_wave, pixels);
            for (uint32_t done = 0; done < count; done += step)
                engine_->render_wave({begin, end - begin, first + done, step});
            device_.finish();
            film_.end_wave(end);
            if (!keep_going(double(end) / pixels)) return;
        }
    }

    uint32_t max_samples() const override {
        return std::bit_floor(std::min(
            {options_.samples_in_flight, engine_->sample_capacity(), engine_->wave_capacity()}));
    }

    Film& film() override { return film_; }
    const gpu::BuildReport& build_report() const override { return engine_->build_report(); }
    const RenderBuffers& buffers() const override { return buffers_; }

    RayCounts ray_counts() const override { return ray_counts_of(engine_->counters()); }

  private:
    static const RenderOptions& checked(const RenderOptions& options) {
        check_options(options);
        return options;
    }

    const gpu::Device& device_;
    RenderOptions options_;
    RenderBuffers buffers_;
    Film film_;
    std::unique_ptr<EngineDriver> engine_;
};

} // namespace

std::unique_ptr<Integrator> make_wave_integrator(const IntegratorContext& context,
                                                 const EngineFactory& make) {
    return std::make_unique<WaveIntegrator>(context, make);
}

} // namespace onde
