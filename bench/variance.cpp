#include "variance.h"

#include "front.h"

#include "core/timer.h"
#include "session/choices.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace onde::bench {

Variance variance_over_seeds(Session& session, uint32_t seeds) {
    Variance v;
    v.seconds = INFINITY;
    std::vector<double> sums, squares;
    for (uint32_t seed = 1; seed <= seeds; seed++) {
        RenderOptions options = session.options();
        options.seed = seed;
        session.set_options(options);
        session.prepare();
        const Timer timer;
        session.render();
        v.seconds = std::min(v.seconds, timer.seconds());
        const Image picture = session.picture();
        sums.resize(picture.pixels.size());
        squares.resize(picture.pixels.size());
        for (size_t i = 0; i < picture.pixels.size(); i++) {
            const double value = double(picture.pixels[i]);
            sums[i] += value;
            squares[i] += value * value;
        }
    }
    std::vector<double> relative;
    for (size_t i = 0; i < sums.size(); i++) {
        const double mean = sums[i] / seeds;
        const double variance = (squares[i] / seeds - mean * mean) * seeds / (seeds - 1);
        relative.push_back(std::max(variance, 0.0) / (mean * mean + 0.01));
        v.mean += mean / double(sums.size());
    }
    std::ranges::sort(relative);
    const auto mean_of = [&](size_t count) {
        return std::accumulate(relative.begin(), relative.begin() + ptrdiff_t(count), 0.0) /
               double(count);
    };
    v.all = mean_of(relative.size());
    v.trimmed = mean_of(relative.size() - relative.size() / 1000);
    return v;
}

void add_variance(Command& command, VarianceOptions& options) {
    command.option("--width", &options.width, "of the pictures",
                   {.show_default = true, .least = 1, .most = 16384});
    command.option("--height", &options.height, "of the pictures",
                   {.show_default = true, .least = 1, .most = 16384});
    command.option("--samples", &options.samples, "of a pixel",
                   {.value = "N", .show_default = true, .least = 1, .most = 1 << 24});
    command.option("--seeds", &options.seeds, "pictures over which a variance is taken",
                   {.value = "N", .show_default = true, .least = 2, .most = 100000});
    add_device(command, options.device);
    add_kernels(command, options.kernels);
}

Session variance_session(Machine& machine, const Scene& scene, const VarianceOptions& options,
                         const LightOptions& lights) {
    RenderChoices choices;
    choices.width = options.width;
    choices.height = options.height;
    choices.samples = options.samples;
    choices.integrator = IntegratorKind::path;
    choices.filter = Filter::box;
    return Session(machine.programs, scene,
                   {.render = resolve_options(choices, scene, machine.device.facts()).options,
                    .lights = lights});
}

} // namespace onde::bench
