#include "engines_contender.h"

#include "upload/layout_choice.h"

#include <algorithm>
#include <cmath>

namespace onde::bench {
namespace {

SessionOptions onde_options(const gpu::DeviceFacts& facts, const FrameOptions& frame,
                            const Variant& variant) {
    RenderOptions options;
    options.width = frame.width;
    options.height = frame.height;
    options.samples = frame.samples;
    options.depth = frame.depth;
    options.filter = Filter::box;
    options.engine = variant.engine;
    options.settings = variant.settings;
    return {.render = options, .bvh = {.layout = known_layout(facts)}, .choose_layout = false};
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

OndeEngine::OndeEngine(const gpu::Device& device, const Scene& scene, const FrameOptions& frame,
                       const Variant& variant)
    : programs_(device, gpu::KernelSources::embedded()),
      session_(programs_, scene, onde_options(device.facts(), frame, variant)) {}

Frame OndeEngine::render() {
    session_.clear();
    const RenderOutcome outcome = session_.render();
    return {outcome.seconds, session_.ray_counts().total()};
}

NativeTracer::NativeTracer(const Scene& scene, const FrameOptions& frame, uint32_t threads)
    : options_(native_options(frame, threads)), renderer_(scene) {}

Frame NativeTracer::render() {
    last_ = renderer_.render(options_);
    return {last_.seconds, last_.extension_rays + last_.shadow_rays};
}

Image NativeTracer::picture() {
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
