#include "engines_contender.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace onde::bench {
namespace {

RenderOptions onde_options(const FrameOptions& frame, const Variant& variant) {
    RenderOptions options;
    options.width = frame.width;
    options.height = frame.height;
    options.samples = frame.samples;
    options.depth = frame.depth;
    options.filter = Filter::box;
    options.engine = variant.engine;
    options.settings = variant.settings;
    return options;
}

ReferenceOptions native_options(const FrameOptions& frame, uint32_t threads) {
    ReferenceOptions options;
    options.width = frame.width;
    options.height = frame.height;
    options.samples = frame.samples;
    options.depth = frame.depth;
    options.roulette_start = RenderOptions{}.roulette_start;
    options.threads = threads;
    options.filter = Filter::box;
    return options;
}

/// Of the mean of all values, from their spread alone.
double error_by_spread(const std::vector<glm::vec3>& values) {
    double sum = 0, squares = 0;
    for (const glm::vec3& v : values) {
        const double mean = (double(v.x) + v.y + v.z) / 3;
        sum += mean;
        squares += mean * mean;
    }
    const double n = double(values.size());
    return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)) / n);
}

} // namespace

OndeEngine::OndeEngine(const gpu::Device& device, const DeviceScene& scene, const Camera& camera,
                       const FrameOptions& frame, const Variant& variant)
    : programs_(device, gpu::KernelSources::embedded()), options_(onde_options(frame, variant)),
      integrator_(make_path_integrator(programs_, scene, camera, options_)) {}

Frame OndeEngine::render() {
    const uint64_t rays_before = integrator_->ray_counts().total();
    const std::atomic<bool> never{false};
    const RenderOutcome outcome =
        onde::render(*integrator_, options_, never, [](const Progress&) {});
    return {outcome.seconds, integrator_->ray_counts().total() - rays_before};
}

Image OndeEngine::picture() const {
    return integrator_->film().develop();
}

NativeTracer::NativeTracer(const Scene& scene, const FrameOptions& frame, uint32_t threads)
    : options_(native_options(frame, threads)), renderer_(scene) {}

Frame NativeTracer::render() {
    last_ = renderer_.render(options_);
    return {last_.seconds, last_.extension_rays + last_.shadow_rays};
}

Image NativeTracer::picture() const {
    Image image(last_.width, last_.height, 3);
    for (size_t i = 0; i < last_.mean.size(); i++)
        for (int k = 0; k < 3; k++) image.pixels[3 * i + size_t(k)] = last_.mean[i][k];
    return image;
}

double NativeTracer::standard_error() const {
    if (last_.samples == 1) return error_by_spread(last_.mean);
    double variance = 0;
    for (const glm::vec3& v : last_.variance_of_mean) {
        const double deviation = (std::sqrt(v.x) + std::sqrt(v.y) + std::sqrt(v.z)) / 3;
        variance += deviation * deviation;
    }
    return std::sqrt(variance) / double(last_.variance_of_mean.size());
}

} // namespace onde::bench
