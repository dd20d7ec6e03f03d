#include "render/light_integrator.h"

#include "core/error.h"
#include "render/light_tracing_setup.h"

#include <algorithm>
#include <bit>

namespace onde {
namespace {

EngineContext engine_context(const IntegratorContext& c, RenderBuffers& buffers, const Film& film) {
    return {c.programs, buffers, c.scene, film, c.camera, c.options, c.profiler};
}

const IntegratorContext& checked(const IntegratorContext& context) {
    check_options(context.options);
    if (context.scene.packed().lights.empty())
        throw InputError("--integrator light starts at the lights, but nothing in the scene emits");
    return context;
}

uint64_t row_sum(const std::vector<uint64_t>& row) {
    uint64_t sum = 0;
    for (uint64_t count : row) sum += count;
    return sum;
}

double percent(uint64_t part, uint64_t whole) {
    return whole > 0 ? 100.0 * double(part) / double(whole) : 0.0;
}

} // namespace

LightBuffers::LightBuffers(RenderBuffers& buffers, const RenderOptions& options)
    : splats(buffers.film.add_filled("splats", size_t(options.width) * options.height * SPLAT_WORDS,
                                     uint32_t(0))),
      statistics(buffers.film.add_filled("light statistics", 2 * LIGHT_STATISTICS, uint32_t(0))),
      setup(buffers.film.add<LightTracingRecord>("light tracing", 1)),
      state(buffers.paths.add<float>("light paths", light_state_size(options.settings))) {}

LightIntegrator::LightIntegrator(const IntegratorContext& context)
    : device_(checked(context).device()), options_(context.options), profiler_(context.profiler),
      has_mirrors_(has_smooth_lobes(*context.description)),
      hidden_emitters_(count_hidden_emitters(context.scene.packed())), buffers_(device_),
      film_(context.programs, buffers_.film, options_), light_(buffers_, options_),
      arguments_(engine_context(context, buffers_, film_)),
      program_(build_engine(engine_context(context, buffers_, film_), "wavefront/light_tracing.cl",
                            {"light_tracing", "resolve"})) {
    const LightTracingRecord setup = make_light_tracing(*context.description, options_);
    splat_scale_ = setup.splat_scale;
    light_.setup.write(device_, std::span(&setup, 1));
    gpu::Kernel& kernel = program_.kernel("light_tracing");
    kernel.set_from(arguments_.bind(kernel), light_.setup, light_.splats, light_.statistics,
                    light_.state, uint32_t(light_.state.size() / LIGHT_LANES));
    film_.hold_splats(light_.splats);
}

void LightIntegrator::render_pass(uint32_t first, uint32_t count,
                                  const std::function<bool(double)>& keep_going) {
    const uint32_t pixels = options_.width * options_.height;
    const uint32_t step = std::min(count, max_samples());
    const uint32_t pixels_per_wave = options_.settings.wave_size / step;
    for (uint32_t begin = film_.begin_pass(first, count), end = 0; begin < pixels; begin = end) {
        end = std::min(begin + pixels_per_wave, pixels);
        for (uint32_t done = 0; done < count; done += step)
            trace_wave({begin, end - begin, first + done, step});
        device_.finish();
        film_.end_wave(end);
        if (!keep_going(double(end) / pixels)) break;
    }
    resolve();
}

void LightIntegrator::trace_wave(const Wave& wave) {
    const uint32_t chunk = options_.settings.chunk;
    gpu::Kernel& kernel = program_.kernel("light_tracing");
    arguments_.set_wave(kernel, wave, chunk);
    kernel.launch((wave.paths() + chunk - 1) / chunk, profiler_);
    arguments_.tally(program_, profiler_);
    emitted_ += wave.paths();
}

void LightIntegrator::resolve() {
    const uint32_t pixels = options_.width * options_.height, chunk = options_.settings.chunk;
    const float scale = 1.0f / (splat_scale_ * float(pixels));
    gpu::Kernel& kernel = program_.kernel("resolve");
    kernel.set_from(0, pixels, chunk, light_.splats, film_.sums(), scale, float(film_.samples()));
    kernel.launch((pixels + chunk - 1) / chunk, profiler_);
    device_.finish();
}

uint32_t LightIntegrator::max_samples() const {
    const gpu::DeviceSettings& settings = options_.settings;
    return std::bit_floor(
        std::min({options_.samples_in_flight, settings.chunk, settings.wave_size}));
}

RayCounts LightIntegrator::ray_counts() const {
    return ray_counts_of(arguments_.counters());
}

std::vector<uint64_t> LightIntegrator::statistics() const {
    const std::vector<uint32_t> words = light_.statistics.read(device_);
    std::vector<uint64_t> sums(LIGHT_STATISTICS);
    for (size_t i = 0; i < sums.size(); i++)
        sums[i] = uint64_t(words[2 * i + 1]) << 32 | words[2 * i];
    return sums;
}

LightCounts LightIntegrator::counts() const {
    const std::vector<uint64_t> sums = statistics();
    return {emitted_, sums[LIGHT_CONTRIBUTED], row_sum(ray_counts().shadow), sums[LIGHT_UNBLOCKED]};
}

std::vector<std::string> LightIntegrator::findings() const {
    const LightCounts c = counts();
    std::vector<std::string> sentences{
        fmt::format("{:.3g}% of the {} emitted rays contributed to the picture",
                    percent(c.contributed, c.emitted), c.emitted),
        fmt::format("{:.3g}% of the {} connections to the camera were blocked",
                    percent(c.connections - c.unblocked, c.connections), c.connections)};
    if (has_mirrors_)
        sentences.push_back("light tracing draws smooth mirrors and smooth glass black: what they "
                            "show, no vertex can send to the camera");
    if (hidden_emitters_ > 0)
        sentences.push_back(
            fmt::format("{} glowing surfaces are none of the lights that rays start "
                        "at; their light is missing",
                        hidden_emitters_));
    return sentences;
}

void plan_light_integrator(RenderBuffers& buffers, const RenderOptions& options) {
    JobBuffers(buffers.film, options);
    LightBuffers(buffers, options);
}

std::unique_ptr<Integrator> make_light_integrator(const IntegratorContext& context) {
    return std::make_unique<LightIntegrator>(context);
}

} // namespace onde
