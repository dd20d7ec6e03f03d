// The native competitor on the command line: renders a scene with the Embree reference and prints
// one JSON line of its speed. What Onde's engines are measured against.
#include "core/error.h"
#include "scene/load.h"
#include "support/reference/reference.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <iostream>

namespace {

struct Arguments {
    std::string scene;
    onde::ReferenceOptions options;
    uint32_t repeats = 3;
};

Arguments parse(CLI::App& app, int argc, char** argv) {
    Arguments a;
    a.options.width = 640, a.options.height = 480, a.options.samples = 16;
    app.add_option("scene", a.scene, "Scene file")->required();
    app.add_option("--width", a.options.width, "Pixels")->capture_default_str();
    app.add_option("--height", a.options.height, "Pixels")->capture_default_str();
    app.add_option("--samples", a.options.samples, "Per pixel")->capture_default_str();
    app.add_option("--depth", a.options.depth, "Most surfaces of a path")->capture_default_str();
    app.add_option("--roulette-start", a.options.roulette_start, "First vertex of roulette")
        ->capture_default_str();
    app.add_option("--threads", a.options.threads, "Worker threads")->capture_default_str();
    app.add_option("--seed", a.options.seed, "Of the random numbers")->capture_default_str();
    app.add_option("--repeats", a.repeats, "Renders after a warm-up; the median counts")
        ->capture_default_str();
    app.parse(argc, argv);
    return a;
}

void measure(const Arguments& a) {
    const onde::ReferenceRenderer renderer(onde::load_scene(a.scene));
    onde::ReferenceResult result = renderer.render(a.options); // warms caches and clocks
    std::vector<double> seconds;
    for (uint32_t i = 0; i < std::max(a.repeats, 1u); ++i)
        seconds.push_back(renderer.render(a.options).seconds);
    std::ranges::sort(seconds);
    const double median = seconds[seconds.size() / 2];
    const double paths = double(a.options.width) * a.options.height * a.options.samples;
    const double rays = double(result.extension_rays + result.shadow_rays);
    fmt::print("{{\"engine\": \"embree\", \"scene\": \"{}\", \"width\": {}, \"height\": {}, "
               "\"samples\": {}, \"depth\": {}, \"threads\": {}, \"seconds\": {:.4f}, "
               "\"seconds_min\": {:.4f}, \"seconds_max\": {:.4f}, \"mpaths_per_s\": {:.3f}, "
               "\"mrays_per_s\": {:.3f}, \"extension_rays\": {}, \"shadow_rays\": {}}}\n",
               a.scene, a.options.width, a.options.height, a.options.samples, a.options.depth,
               a.options.threads, median, seconds.front(), seconds.back(), paths / median * 1e-6,
               rays / median * 1e-6, result.extension_rays, result.shadow_rays);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Renders with the Embree reference and prints its speed as one JSON line");
    try {
        measure(parse(app, argc, argv));
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    } catch (const onde::InputError& error) {
        std::cerr << "native_tracer: " << error.what() << '\n';
        return 2;
    } catch (const onde::DeviceError& error) {
        std::cerr << "native_tracer: " << error.what() << '\n';
        return 3;
    }
}
