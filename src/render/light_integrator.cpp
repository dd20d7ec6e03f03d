#include "render/light_integrator.h"

#include "core/error.h"
#include "render/light_tracing_setup.h"
#include "shared/columns.h"

#include <algorithm>
#include <bit>

namespace onde {
namespace {

const IntegratorContext& checked(const IntegratorContext& context) {
    check_options(context.options);
    if (context.scene.packed().lights.empty())
        throw InputError("--integrator light starts at the lights, but nothing in the scene emits");
    if (context.scene.packed().features.media)
        throw InputError("--integrator light knows no media; take --integrator path");
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

LightEstimator::LightEstimator(RenderBuffers& buffers, const Scene& scene,
                               const SceneFeatures& features, const RenderOptions& options)
    : shape_{.file = "light_tracing/estimator.h",
             .defines = {},
             .state_columns = COLUMN_COUNT(LIGHT_PATH_COLUMNS),
             .connection_columns = COLUMN_COUNT(SPLAT_COLUMNS),
             .connects_start = true},
      setup_(make_light_tracing(scene, options)),
      on_device_(buffers.film.add_copy("light tracing", std::vector{setup_})),
      splats_(buffers.film.add_filled(
          "splats", size_t(options.width) * options.height * SPLAT_WORDS, uint32_t(0))),
      statistics_(buffers.film.add_filled("light statistics", 2 * LIGHT_STATISTICS, uint32_t(0))) {
    if (features.shutter) shape_.state_columns += COLUMN_COUNT(TIME_COLUMNS);
    if (features.dispersion) shape_.state_columns += COLUMN_COUNT(WAVE_COLUMNS);
}

uint32_t LightEstimator::bind(gpu::Kernel& kernel, uint32_t first) const {
    return kernel.set_from(first, on_device_, splats_, statistics_);
}

std::vector<uint64_t> LightEstimator::statistics(const gpu::Device& device) const {
    const std::vector<uint32_t> words = statistics_.read(device);
    std::vector<uint64_t> sums(LIGHT_STATISTICS);
    for (size_t i = 0; i < sums.size(); i++)
        sums[i] = uint64_t(words[2 * i + 1]) << 32 | words[2 * i];
    return sums;
}

LightIntegrator::LightIntegrator(const IntegratorContext& context)
    : WaveIntegrator(checked(context),
                     [&](RenderBuffers& buffers) {
                         return std::make_unique<LightEstimator>(buffers, *context.description,
                                                                 context.scene.packed().features,
                                                                 context.options);
                     }),
      profiler_(context.profiler), has_mirrors_(has_smooth_lobes(*context.description)),
      hidden_emitters_(count_hidden_emitters(context.scene.packed())),
      light_(static_cast<const LightEstimator&>(estimator())),
      resolve_(context.programs.build({"film/resolve.cl",
                                       {},
                                       {{"resolve", options().settings.local_size,
                                         size_t(options().width) * options().height}}})) {
    film().hold_splats(light_.splats());
}

void LightIntegrator::end_pass() {
    const uint32_t pixels = options().width * options().height, chunk = options().settings.chunk;
    gpu::Kernel& kernel = resolve_.kernel("resolve");
    kernel.set_from(0, pixels, chunk, light_.splats(), film().sums(),
                    light_.splat_unit() / float(pixels), float(film().samples()));
    kernel.launch((pixels + chunk - 1) / chunk, profiler_);
    device().finish();
}

LightCounts LightIntegrator::counts() const {
    const std::vector<uint64_t> sums = light_.statistics(device());
    return {paths(), sums[LIGHT_CONTRIBUTED], row_sum(ray_counts().shadow), sums[LIGHT_UNBLOCKED]};
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

std::unique_ptr<Integrator> make_light_integrator(const IntegratorContext& context) {
    return std::make_unique<LightIntegrator>(context);
}

} // namespace onde
